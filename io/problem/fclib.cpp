// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib.hpp"

#include "io/problem/fclib_matrix.hpp"
#include "io/problem/hdf5_reader.hpp"
#include "io/problem/hdf5_writer.hpp"
#include "io/run/run_files.hpp"
#include "io/scene/trial_run.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <utility>

namespace talus
{

namespace
{

using Eigen::Index;
using Eigen::VectorXd;

/// In the order in which they are looked for.
constexpr std::array<std::pair<FclibForm, const char*>, 3> groups = {{{FclibForm::global, "/fclib_global"},
    {FclibForm::global_rolling, "/fclib_global_rolling"}, {FclibForm::local, "/fclib_local"}}};

std::string group_of(FclibForm form)
{
    for (const auto& [known, group] : groups)
        if (known == form) return group;
    return {};
}

FclibForm find_form(const Hdf5Reader& file)
{
    for (const auto& [form, group] : groups)
        if (file.has(group)) return form;
    file.refuse("/fclib_local, /fclib_global and /fclib_global_rolling", "are missing: it holds no contact problem");
}

VectorXd read_vector(Hdf5Reader& file, const std::string& path)
{
    VectorXd values = file.numbers(path);
    check_finite(file, path, values, values.size());
    return values;
}

VectorXd read_vector(Hdf5Reader& file, const std::string& path, Index wanted)
{
    VectorXd values = read_vector(file, path);
    if (values.size() != wanted) file.refuse(path, fmt::format("must have {} values, not {}", wanted, values.size()));
    return values;
}

VectorXd read_vector_if_any(Hdf5Reader& file, const std::string& path, Index wanted)
{
    return file.has(path) ? read_vector(file, path, wanted) : VectorXd();
}

void check_friction(const Hdf5Reader& file, const std::string& path, const VectorXd& friction)
{
    for (Index k = 0; k < friction.size(); ++k)
        if (friction[k] < 0.0)
            file.refuse(fmt::format("{}[{}]", path, k), fmt::format("must be at least 0, not {}", friction[k]));
}

int read_rows_per_contact(Hdf5Reader& file, FclibForm form)
{
    const std::string path = group_of(form) + "/spacedim";
    const std::int64_t rows = file.whole_number(path);
    const bool rolling = form == FclibForm::global_rolling;
    if (rolling ? rows != 5 : rows != 2 && rows != 3)
        file.refuse(path, fmt::format("must be {}, not {}", rolling ? "5" : "2 or 3", rows));
    return static_cast<int>(rows);
}

void read_contacts(Hdf5Reader& file, FclibProblem& problem)
{
    problem.rows_per_contact = read_rows_per_contact(file, problem.form);
    const std::string vectors = group_of(problem.form) + "/vectors";
    problem.mu = read_vector(file, vectors + "/mu");
    check_friction(file, vectors + "/mu", problem.mu);
    if (problem.form != FclibForm::global_rolling) return;
    problem.mu_r = read_vector(file, vectors + "/mu_r", problem.contacts());
    check_friction(file, vectors + "/mu_r", problem.mu_r);
}

Index contact_rows(const FclibProblem& problem)
{
    return problem.rows_per_contact * problem.contacts();
}

void read_local(Hdf5Reader& file, FclibProblem& problem)
{
    const std::string group = group_of(problem.form);
    for (const char* name : {"/V", "/R"})
        if (file.has(group + name))
            file.refuse(group + name, "states constraints, which are read in the global form only");
    problem.q = read_vector(file, group + "/vectors/q", contact_rows(problem));
    problem.W = read_fclib_matrix(file, group + "/W", problem.q.size(), problem.q.size());
}

void read_global(Hdf5Reader& file, FclibProblem& problem)
{
    const std::string group = group_of(problem.form);
    problem.f = read_vector(file, group + "/vectors/f");
    problem.w = read_vector(file, group + "/vectors/w", contact_rows(problem));
    const Index rows = problem.f.size();
    problem.M = read_fclib_matrix(file, group + "/M", rows, rows);
    problem.H = read_fclib_matrix(file, group + "/H", rows, problem.w.size());
    problem.G.resize(rows, 0);
    if (!file.has(group + "/G")) return;
    problem.b = read_vector(file, group + "/vectors/b");
    problem.G = read_fclib_matrix(file, group + "/G", rows, problem.b.size());
}

std::string read_text(Hdf5Reader& file, const std::string& path)
{
    return file.has(path) ? file.text(path) : std::string();
}

FclibGuess read_guess(Hdf5Reader& file, const std::string& group, const FclibProblem& problem)
{
    const Index rows = contact_rows(problem);
    FclibGuess guess;
    guess.v = read_vector_if_any(file, group + "/v", problem.f.size());
    guess.u = read_vector_if_any(file, group + "/u", rows);
    guess.r = read_vector_if_any(file, group + "/r", rows);
    guess.l = read_vector_if_any(file, group + "/l", problem.b.size());
    return guess;
}

std::vector<FclibGuess> read_guesses(Hdf5Reader& file, const FclibProblem& problem)
{
    if (!file.has("/guesses")) return {};
    const std::string path = "/guesses/number_of_guesses";
    const std::int64_t count = file.whole_number(path);
    if (count < 0) file.refuse(path, fmt::format("must be at least 0, not {}", count));
    std::vector<FclibGuess> guesses;
    for (std::int64_t k = 1; k <= count; ++k) {
        const std::string group = fmt::format("/guesses/{}", k);
        if (!file.has(group)) file.refuse(group, fmt::format("is missing, but there must be {} guesses", count));
        guesses.push_back(read_guess(file, group, problem));
    }
    return guesses;
}

void write_if_any(Hdf5Writer& file, const std::string& path, const VectorXd& values)
{
    if (values.size() > 0) file.add(path, values);
}

void write_guess(Hdf5Writer& file, const std::string& group, const FclibGuess& guess)
{
    file.add_group(group);
    write_if_any(file, group + "/v", guess.v);
    write_if_any(file, group + "/u", guess.u);
    write_if_any(file, group + "/r", guess.r);
    write_if_any(file, group + "/l", guess.l);
}

void write_guesses(Hdf5Writer& file, const std::vector<FclibGuess>& guesses)
{
    if (guesses.empty()) return;
    file.add("/guesses/number_of_guesses", static_cast<int>(guesses.size()));
    for (std::size_t k = 0; k < guesses.size(); ++k) write_guess(file, fmt::format("/guesses/{}", k + 1), guesses[k]);
}

void write_local(Hdf5Writer& file, const std::string& group, const FclibProblem& problem)
{
    assert(problem.q.size() == contact_rows(problem));
    assert(problem.W.rows() == problem.q.size() && problem.W.cols() == problem.q.size());
    write_fclib_matrix(file, group + "/W", problem.W);
    file.add(group + "/vectors/q", problem.q);
}

void write_global(Hdf5Writer& file, const std::string& group, const FclibProblem& problem)
{
    assert(problem.w.size() == contact_rows(problem));
    assert(problem.M.rows() == problem.f.size() && problem.M.cols() == problem.f.size());
    assert(problem.H.rows() == problem.f.size() && problem.H.cols() == problem.w.size());
    write_fclib_matrix(file, group + "/M", problem.M);
    write_fclib_matrix(file, group + "/H", problem.H);
    file.add(group + "/vectors/f", problem.f);
    file.add(group + "/vectors/w", problem.w);
    if (problem.G.cols() == 0) return;
    assert(problem.G.rows() == problem.f.size() && problem.G.cols() == problem.b.size());
    write_fclib_matrix(file, group + "/G", problem.G);
    file.add(group + "/vectors/b", problem.b);
}

void write_texts(Hdf5Writer& file, const std::string& group, const FclibProblem& problem)
{
    if (!problem.title.empty()) file.add(group + "/info/title", problem.title);
    if (!problem.description.empty()) file.add(group + "/info/description", problem.description);
}

} // namespace

FclibProblem parse_fclib(const std::string& bytes, const std::string& name)
{
    Hdf5Reader file(bytes, name);
    FclibProblem problem;
    problem.form = find_form(file);
    read_contacts(file, problem);
    if (problem.form == FclibForm::local)
        read_local(file, problem);
    else
        read_global(file, problem);
    problem.title = read_text(file, group_of(problem.form) + "/info/title");
    problem.description = read_text(file, group_of(problem.form) + "/info/description");
    problem.guesses = read_guesses(file, problem);
    problem.solution = read_guess(file, "/solution", problem);
    return problem;
}

FclibProblem read_fclib(const std::filesystem::path& path)
{
    const std::string bytes = read_bytes(path, "an HDF5 file"), name = path.string();
    // measured: 266 MB need 2 s and 1.2 GB
    const TrialLimits limits{.seconds = 120, .memory = (std::size_t{64} << 20) + 16 * bytes.size()};
    const auto crashed = fmt::format("{}: HDF5 crashes on it: the file is damaged", name);
    try_in_a_copy([&] { parse_fclib(bytes, name); }, limits, crashed);
    return parse_fclib(bytes, name);
}

void write_fclib(const FclibProblem& problem, const std::filesystem::path& path)
{
    const std::string group = group_of(problem.form);
    Hdf5Writer file(path.string());
    file.add(group + "/spacedim", problem.rows_per_contact);
    if (problem.form == FclibForm::local)
        write_local(file, group, problem);
    else
        write_global(file, group, problem);
    file.add(group + "/vectors/mu", problem.mu);
    if (problem.form == FclibForm::global_rolling) file.add(group + "/vectors/mu_r", problem.mu_r);
    write_texts(file, group, problem);
    write_guesses(file, problem.guesses);
    const FclibGuess& found = problem.solution;
    if (found.v.size() + found.u.size() + found.r.size() + found.l.size() > 0) write_guess(file, "/solution", found);
    write_atomically(path, file.bytes());
}

} // namespace talus
