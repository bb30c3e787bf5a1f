// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib.hpp"

#include "io/problem/hdf5.hpp"
#include "io/run/run_files.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace talus
{

namespace
{

using Eigen::Index;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// In the order in which they are looked for.
constexpr std::array<std::pair<FclibForm, const char*>, 3> groups = {{{FclibForm::global, "/fclib_global"},
    {FclibForm::global_rolling, "/fclib_global_rolling"}, {FclibForm::local, "/fclib_local"}}};

std::string group_of(FclibForm form)
{
    return std::ranges::find(groups, form, &std::pair<FclibForm, const char*>::first)->second;
}

// `transfer` reads a part of a problem from the datasets of a file, or writes it there, whichever the file is for. The
// sizes that it is given are required of the file, and asserted of a problem to be written.

constexpr Index any_size = -1;

void check_size(const Hdf5Reader& file, const std::string& path, Index found, Index wanted)
{
    if (found != wanted) file.refuse(path, fmt::format("must have {} values, not {}", wanted, found));
}

/// Of the first `count`.
void check_finite(const Hdf5Reader& file, const std::string& path, const VectorXd& values, Index count)
{
    for (Index k = 0; k < count; ++k)
        if (!std::isfinite(values[k]))
            file.refuse(fmt::format("{}[{}]", path, k), fmt::format("is {}, not a finite number", values[k]));
}

void transfer(const Hdf5Reader& file, const std::string& path, VectorXd& values, Index size = any_size)
{
    values = file.numbers(path);
    check_finite(file, path, values, values.size());
    if (size != any_size) check_size(file, path, values.size(), size);
}

void transfer(Hdf5Writer& file, const std::string& path, const VectorXd& values, [[maybe_unused]] Index size = any_size)
{
    assert(size == any_size || values.size() == size);
    file.add(path, values);
}

void transfer(const Hdf5Reader& file, const std::string& path, std::string& text)
{
    text = file.text(path);
}

void transfer(Hdf5Writer& file, const std::string& path, const std::string& text)
{
    file.add(path, text);
}

// A sparse matrix is a group of m (rows), n (columns), nzmax, nz, p, i and x, named as in CSparse
// [Davis 2006, "Direct Methods for Sparse Linear Systems", 2.1].
//
//   nz ≥ 0     nz triplets: rows i, columns p, values x
//   nz = −1    compressed columns: p[j] … p[j + 1] are the entries of column j, in rows i with values x
//   nz = −2    compressed rows: p[i] … p[i + 1] are the entries of row i, in columns i with values x

constexpr int compressed_rows = -2;

int read_count(const Hdf5Reader& file, const std::string& path, int smallest, int largest)
{
    const int found = file.whole_number(path);
    if (found < smallest || found > largest)
        file.refuse(path, fmt::format("must be from {} to {}, not {}", smallest, largest, found));
    return found;
}

void check_count(const Hdf5Reader& file, const std::string& path, Index wanted)
{
    const int found = file.whole_number(path);
    if (found != wanted) file.refuse(path, fmt::format("must be {} to go with the vectors, not {}", wanted, found));
}

std::vector<int> read_list(const Hdf5Reader& file, const std::string& path, Index size)
{
    std::vector<int> values = file.whole_numbers(path);
    check_size(file, path, static_cast<Index>(values.size()), size);
    return values;
}

/// Of every entry the column, or row, that it belongs to by the pointers.
std::vector<int> read_pointers(const Hdf5Reader& file, const std::string& path, Index lines, int entries)
{
    const std::vector<int> pointers = read_list(file, path, lines + 1);
    if (pointers.front() != 0) file.refuse(path, fmt::format("must begin with 0, not {}", pointers.front()));
    const auto fall = std::ranges::adjacent_find(pointers, std::greater<>());
    if (fall != pointers.end())
        file.refuse(path, fmt::format("must not fall, as it does from {} to {}", *fall, fall[1]));
    if (pointers.back() > entries)
        file.refuse(path, fmt::format("must end with at most nzmax = {}, not {}", entries, pointers.back()));
    std::vector<int> line_of_entry;
    for (std::size_t line = 0; line + 1 < pointers.size(); ++line)
        line_of_entry.resize(static_cast<std::size_t>(pointers[line + 1]), static_cast<int>(line));
    return line_of_entry;
}

void check_index(const Hdf5Reader& file, const std::string& group, const char* what, int index, Index end)
{
    if (index < 0 || index >= end)
        file.refuse(group, fmt::format("has an entry in {} {}; its {}s are 0 to {}", what, index, what, end - 1));
}

void transfer(const Hdf5Reader& file, const std::string& group, Sparse& matrix, Index rows, Index columns)
{
    check_count(file, group + "/m", rows);
    check_count(file, group + "/n", columns);
    const int nzmax = read_count(file, group + "/nzmax", 0, std::numeric_limits<int>::max());
    const int nz = read_count(file, group + "/nz", compressed_rows, nzmax), stored = nz >= 0 ? nz : nzmax;
    const bool by_row = nz == compressed_rows;
    std::vector<int> row = read_list(file, group + "/i", stored);
    std::vector<int> column = nz >= 0 ? read_list(file, group + "/p", stored)
                                      : read_pointers(file, group + "/p", by_row ? rows : columns, nzmax);
    if (by_row) std::swap(row, column);
    const VectorXd values = file.numbers(group + "/x");
    if (values.size() != nzmax) check_size(file, group + "/x", values.size(), stored); // old releases wrote nzmax
    const std::size_t count = std::min(row.size(), column.size());
    check_finite(file, group + "/x", values, static_cast<Index>(count));

    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < count; ++k) {
        check_index(file, group, "row", row[k], rows);
        check_index(file, group, "column", column[k], columns);
        entries.emplace_back(row[k], column[k], values[static_cast<Index>(k)]);
    }
    matrix.resize(rows, columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
}

/// As triplets, column by column.
void transfer(Hdf5Writer& file, const std::string& group, const Sparse& matrix, Index rows, Index columns)
{
    assert(matrix.rows() == rows && matrix.cols() == columns);
    std::vector<int> row, column;
    std::vector<double> values;
    for (int j = 0; j < matrix.outerSize(); ++j)
        for (Sparse::InnerIterator entry(matrix, j); entry; ++entry) {
            row.push_back(static_cast<int>(entry.row()));
            column.push_back(static_cast<int>(entry.col()));
            values.push_back(entry.value());
        }
    const int count = static_cast<int>(values.size());
    file.add(group + "/nzmax", count);
    file.add(group + "/m", static_cast<int>(rows));
    file.add(group + "/n", static_cast<int>(columns));
    file.add(group + "/nz", count);
    file.add(group + "/p", column);
    file.add(group + "/i", row);
    file.add(group + "/x", VectorXd(VectorXd::Map(values.data(), count)));
}

bool has(const Hdf5Reader& file, const std::string& path, const auto&)
{
    return file.has(path);
}

bool has(const Hdf5Writer&, const std::string&, const auto& part)
{
    return part.size() > 0;
}

void transfer_if_any(auto& file, const std::string& path, auto& part, auto... size)
{
    if (has(file, path, part)) transfer(file, path, part, size...);
}

/// All but guesses and solution. @pre form and rows_per_contact are known
void transfer_problem(auto& file, auto& problem)
{
    const std::string group = group_of(problem.form), vectors = group + "/vectors";
    transfer(file, vectors + "/mu", problem.mu);
    if (problem.form == FclibForm::global_rolling) transfer(file, vectors + "/mu_r", problem.mu_r, problem.contacts());
    const Index contact_rows = problem.contact_rows();
    if (problem.form == FclibForm::local) {
        transfer(file, vectors + "/q", problem.q, contact_rows);
        transfer(file, group + "/W", problem.W, contact_rows, contact_rows);
    } else {
        transfer(file, vectors + "/f", problem.f);
        transfer(file, vectors + "/w", problem.w, contact_rows);
        const Index body_rows = problem.f.size();
        transfer(file, group + "/M", problem.M, body_rows, body_rows);
        transfer(file, group + "/H", problem.H, body_rows, contact_rows);
        if (has(file, group + "/G", problem.G)) {
            transfer(file, vectors + "/b", problem.b);
            transfer(file, group + "/G", problem.G, body_rows, problem.b.size());
        }
    }
    transfer_if_any(file, group + "/info/title", problem.title);
    transfer_if_any(file, group + "/info/description", problem.description);
}

void transfer_guess(auto& file, const std::string& group, auto& guess, const FclibProblem& problem)
{
    transfer_if_any(file, group + "/v", guess.v, problem.f.size());
    transfer_if_any(file, group + "/u", guess.u, problem.contact_rows());
    transfer_if_any(file, group + "/r", guess.r, problem.contact_rows());
    transfer_if_any(file, group + "/l", guess.l, problem.b.size());
}

FclibForm find_form(const Hdf5Reader& file)
{
    for (const auto& [form, group] : groups)
        if (file.has(group)) return form;
    file.refuse("/fclib_local, /fclib_global and /fclib_global_rolling", "are missing: it holds no contact problem");
}

int read_rows_per_contact(const Hdf5Reader& file, FclibForm form)
{
    const std::string path = group_of(form) + "/spacedim";
    const int rows = file.whole_number(path);
    const bool rolling = form == FclibForm::global_rolling;
    if (rolling ? rows != 5 : rows != 2 && rows != 3)
        file.refuse(path, fmt::format("must be {}, not {}", rolling ? "5" : "2 or 3", rows));
    return rows;
}

void check_friction(const Hdf5Reader& file, const std::string& path, const VectorXd& friction)
{
    for (Index k = 0; k < friction.size(); ++k)
        if (friction[k] < 0.0)
            file.refuse(fmt::format("{}[{}]", path, k), fmt::format("must be at least 0, not {}", friction[k]));
}

void check_no_constraints(const Hdf5Reader& file)
{
    for (const char* group : {"/fclib_local/V", "/fclib_local/R"})
        if (file.has(group)) file.refuse(group, "states constraints, which are read in the global form only");
}

std::vector<FclibGuess> read_guesses(const Hdf5Reader& file, const FclibProblem& problem)
{
    if (!file.has("/guesses")) return {};
    const std::string path = "/guesses/number_of_guesses";
    const int count = file.whole_number(path);
    if (count < 0) file.refuse(path, fmt::format("must be at least 0, not {}", count));
    std::vector<FclibGuess> guesses;
    for (int k = 1; k <= count; ++k) {
        const std::string group = fmt::format("/guesses/{}", k);
        if (!file.has(group)) file.refuse(group, fmt::format("is missing, but there must be {} guesses", count));
        transfer_guess(file, group, guesses.emplace_back(), problem);
    }
    return guesses;
}

void write_guesses(Hdf5Writer& file, const FclibProblem& problem)
{
    if (problem.guesses.empty()) return;
    file.add("/guesses/number_of_guesses", static_cast<int>(problem.guesses.size()));
    for (std::size_t k = 0; k < problem.guesses.size(); ++k) {
        const std::string group = fmt::format("/guesses/{}", k + 1);
        file.add_group(group); // also of a guess of nothing
        transfer_guess(file, group, problem.guesses[k], problem);
    }
}

void read_origin(const Hdf5Reader& file, FclibProblem& problem)
{
    for (const std::string list : origin_lists)
        if (file.has("/talus/" + list)) transfer(file, "/talus/" + list, problem.origin[list]);
}

void write_origin(Hdf5Writer& file, const FclibProblem& problem)
{
    for (const auto& [list, numbers] : problem.origin) transfer(file, "/talus/" + list, numbers);
}

} // namespace

FclibProblem read_fclib(const std::filesystem::path& path)
{
    const Hdf5Reader file(read_bytes(path, "an HDF5 file"), path.string());
    FclibProblem problem;
    problem.form = find_form(file);
    problem.rows_per_contact = read_rows_per_contact(file, problem.form);
    if (problem.form == FclibForm::local) check_no_constraints(file);
    transfer_problem(file, problem);
    check_friction(file, group_of(problem.form) + "/vectors/mu", problem.mu);
    check_friction(file, group_of(problem.form) + "/vectors/mu_r", problem.mu_r);
    if (problem.G.cols() == 0) problem.G.resize(problem.f.size(), 0);
    problem.guesses = read_guesses(file, problem);
    transfer_guess(file, "/solution", problem.solution, problem);
    read_origin(file, problem);
    return problem;
}

void write_fclib(const FclibProblem& problem, const std::filesystem::path& path)
{
    Hdf5Writer file(path.string());
    file.add(group_of(problem.form) + "/spacedim", problem.rows_per_contact);
    transfer_problem(file, problem);
    write_guesses(file, problem);
    transfer_guess(file, "/solution", problem.solution, problem);
    write_origin(file, problem);
    write_atomically(path, file.bytes());
}

} // namespace talus
