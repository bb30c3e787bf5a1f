// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/solve_problem.hpp"

#include "app/system/terminal.hpp"
#include "app/verbs/solve_report.hpp"
#include "core/multibody/algorithm_2_1.hpp"
#include "core/multibody/algorithm_3_1.hpp"
#include "io/run/run_files.hpp"

#include <chrono>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::VectorXd;
using namespace multibody;
namespace fs = std::filesystem;

/// The errors after each sweep as a CSV file, in the units of the problem.
class History
{
public:
    explicit History(const fs::path& path)
        : file_(path,
              {"sweep", "seconds", "residual", "worst_velocity_violation", "worst_spin_violation", "cone_violation"})
    {
    }

    template <class AnyIterate> void add(int sweeps, double seconds, const AnyIterate& x)
    {
        const ErrorMeasures errors = measure_errors(x);
        file_.add_row({static_cast<double>(sweeps), seconds, errors.natural_map, errors.worst_velocity_violation,
            errors.worst_spin_violation, errors.cone_violation});
    }

private:
    MetricsFile file_;
};

/// @param solve calls the algorithm with an observer
template <class AnyIterate, class Solve>
TimedReport timed(const AnyIterate& x, const fs::path& history_path, Solve&& solve)
{
    std::optional<History> history;
    if (!history_path.empty()) history.emplace(history_path);
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    const auto begun = Clock::now();
    double held = 0.0; // while the errors were measured
    SweepObserver observer;
    if (history)
        observer = [&](int sweeps) {
            const auto now = Clock::now();
            history->add(sweeps, since(begun) - held, x);
            held += since(now);
        };
    TimedReport report = solve(observer);
    report.seconds = since(begun) - held;
    return report;
}

TimedReport solve(Iterate& x, const SolveRequest& request)
{
    return timed(x, request.history, [&](const SweepObserver& observer) -> TimedReport {
        switch (request.algorithm) {
        case Algorithm::residual_update:
            return {solve_with_residual_update(x, request.settings, observer)};
        case Algorithm::local_residual: {
            const auto report = solve_with_local_residual(x, request.settings, observer);
            return {report, 0.0, report.running_error};
        }
        case Algorithm::projected:
            break;
        }
        return {solve_projected(x, request.settings, observer)};
    });
}

TimedReport solve(AssembledIterate& x, const SolveRequest& request)
{
    return timed(x, request.history,
        [&](const SweepObserver& observer) -> TimedReport { return {solve_projected(x, request.settings, observer)}; });
}

void require_algorithm(const SolveRequest& request, const FclibProblem& file)
{
    if (request.algorithm == Algorithm::projected) return;
    if (file.form == FclibForm::local)
        throw UsageError(
            "algorithms 2.1 and 2.2 go by way of the bodies, which a local problem does not have; use 3.1");
    if (file.contacts() > 0)
        throw UsageError(fmt::format(
            "algorithms 2.1 and 2.2 solve equalities, and this problem has {} contacts; use 3.1", file.contacts()));
}

/// λ⁰: zero, or a guess of the file.
VectorXd first_impulse(const SolveRequest& request, const FclibProblem& file, Index rows)
{
    VectorXd impulse = VectorXd::Zero(rows);
    if (request.guess == 0) return impulse;
    if (static_cast<std::size_t>(request.guess) > file.guesses.size())
        throw UsageError(fmt::format("there is no guess {}: the file has {}", request.guess, file.guesses.size()));
    const FclibGuess& guess = file.guesses[static_cast<std::size_t>(request.guess) - 1];
    if (guess.r.size() == 0 && file.contacts() > 0)
        throw UsageError(fmt::format("guess {} of the file has no reactions r", request.guess));
    impulse.head(guess.r.size()) = guess.r;
    impulse.tail(guess.l.size()) = guess.l;
    return impulse;
}

/// r, l and u of an iterate; u is what FCLIB calls so, the law's velocity.
template <class AnyIterate> void store_solution(const AnyIterate& x, FclibProblem& file)
{
    const Index contact_rows = file.rows_per_contact * file.contacts();
    file.solution.r = x.impulse().head(contact_rows);
    file.solution.l = x.impulse().tail(x.impulse().size() - contact_rows);
    file.solution.u.resize(contact_rows);
    for (std::size_t k = 0; k < static_cast<std::size_t>(file.contacts()); ++k)
        x.residual_of(k, file.solution.u.segment(x.constraints()[k].first_row, x.constraints()[k].rows));
}

template <class AnyIterate, class AnyProblem>
ExitCode solve_and_tell(AnyIterate& x, const AnyProblem& problem, const CommandLine& line, FclibProblem& file)
{
    const bool speaks = line.verbosity != Verbosity::quiet;
    if (speaks) print_problem(file);
    if (speaks) print_rank(problem);
    const auto start = line.solve.guess == 0 ? std::string("zero") : fmt::format("guess {}", line.solve.guess);
    if (speaks) say("start: {}\n", start);
    const TimedReport report = solve(x, line.solve);
    if (speaks) print_result(x, report, line.solve.settings.tolerance);
    store_solution(x, file);
    if constexpr (std::is_same_v<AnyProblem, ProblemWithBodies>)
        file.solution.v = problem.in_order_of_matrices(x.velocity());
    if (!report.converged) warn("{}: {}\n", line.solve.problem.string(), complaint(report));
    if (!line.out.empty() && report.finite) write_fclib(file, line.out);
    return report.converged ? ExitCode::done : ExitCode::not_converged;
}

} // namespace

ExitCode solve_problem(const CommandLine& line)
{
    const SolveRequest& request = line.solve;
    for (const auto& path : {request.history, line.out})
        if (!path.empty()) require_writable(path, line.force, {request.problem});
    FclibProblem file = read_fclib(request.problem);
    const std::string name = request.problem.string();
    require_algorithm(request, file);
    if (file.form == FclibForm::local) {
        const auto problem = assembled(file, name);
        AssembledIterate x(problem, first_impulse(request, file, problem.target.size()));
        return solve_and_tell(x, problem, line, file);
    }
    const auto bodies = with_bodies(file, name);
    Iterate x(bodies.problem, first_impulse(request, file, bodies.problem.rows()));
    return solve_and_tell(x, bodies, line, file);
}

} // namespace talus
