// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/solve_problem.hpp"

#include "app/terminal.hpp"
#include "core/multibody/algorithm_2_1.hpp"
#include "core/multibody/algorithm_2_2.hpp"
#include "core/multibody/algorithm_3_1.hpp"
#include "io/fclib_problem.hpp"
#include "io/input_error.hpp"
#include "io/run_files.hpp"

#include <chrono>
#include <optional>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::VectorXd;
using namespace multibody;
namespace fs = std::filesystem;

/// A clock that can be held while something is done that is not to be timed.
class StopWatch
{
public:
    /// What it shows [s].
    double seconds() const { return before_ + (runs_ ? running() : 0.0); }

    void hold()
    {
        before_ = seconds();
        runs_ = false;
    }

    void go_on()
    {
        begun_ = Clock::now();
        runs_ = true;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begun_ = Clock::now();
    double before_ = 0.0; ///< shown when it was last held
    bool runs_ = true;

    double running() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }
};

/// The errors after each sweep as a CSV file, in the units of the problem.
class History
{
public:
    explicit History(const std::filesystem::path& path)
        : file_(path, {"sweep", "seconds", "residual", "worst_velocity_error", "worst_spin_error", "cone_violation"})
    {
    }

    template <class AnyIterate> void add(int sweeps, double seconds, const AnyIterate& x)
    {
        const ErrorMeasures errors = measure_errors(x);
        file_.add_row({static_cast<double>(sweeps), seconds, errors.natural_map, errors.worst_velocity_error,
            errors.worst_spin_error, errors.cone_violation});
    }

private:
    MetricsFile file_;
};

/// How a solve went and how long it took.
struct TimedReport : SolveReport {
    double seconds = 0.0;
    std::optional<RunningError> running_error = {}; ///< of Algorithm 2.2
};

/// @param solve calls the algorithm with an observer
template <class AnyIterate, class Solve>
TimedReport timed(const AnyIterate& x, const std::filesystem::path& history_path, Solve&& solve)
{
    std::optional<History> history;
    if (!history_path.empty()) history.emplace(history_path);
    StopWatch watch;
    SweepObserver observer;
    if (history)
        observer = [&](int sweeps) {
            watch.hold();
            history->add(sweeps, watch.seconds(), x);
            watch.go_on();
        };
    TimedReport report = solve(observer);
    report.seconds = watch.seconds();
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

const char* form_name(FclibForm form)
{
    switch (form) {
    case FclibForm::local:
        return "local";
    case FclibForm::global:
        return "global";
    case FclibForm::global_rolling:
        return "global rolling";
    }
    return "";
}

void print_problem(const FclibProblem& file)
{
    const Index equalities = file.G.cols(), rows = file.rows_per_contact * file.contacts() + equalities;
    if (!file.title.empty()) say("{}\n", file.title);
    say("{} form: {} contacts of {} rows", form_name(file.form), file.contacts(), file.rows_per_contact);
    if (equalities > 0) say(", {} equalities", equalities);
    say(", {} rows in all\n", rows);
    if (file.contacts() > 0) say("friction: {:.4g} to {:.4g}\n", file.mu.minCoeff(), file.mu.maxCoeff());
    if (file.mu_r.size() > 0) say("rolling friction: {:.4g} to {:.4g}\n", file.mu_r.minCoeff(), file.mu_r.maxCoeff());
}

/// Degrees of freedom that some constraint touches: the rank of S is no larger.
Index touched_dofs(const Problem& problem)
{
    std::vector<bool> touched(problem.body_count(), false);
    Index dofs = 0;
    for (std::size_t i = 0; i < problem.block_count(); ++i) {
        const auto body = problem.body_of_block(i);
        if (!touched[body]) dofs += problem.mass(body).rows();
        touched[body] = true;
    }
    return dofs;
}

void print_rank(const ProblemWithBodies& bodies)
{
    const Problem& problem = bodies.problem;
    const Index dofs = touched_dofs(problem);
    say("bodies: {} degrees of freedom, {} of them touched; rank at most {} of {} rows{}\n", problem.dofs(), dofs,
        std::min(dofs, problem.rows()), problem.rows(),
        dofs < problem.rows() ? ": the impulses may not be unique" : "");
}

void print_rank(const AssembledProblem& problem)
{
    const double entries = static_cast<double>(problem.schur.nonZeros());
    say("W: {} entries, {:.1f} in a row; without bodies nothing is known of its rank\n", problem.schur.nonZeros(),
        entries / static_cast<double>(std::max<Index>(1, problem.schur.rows())));
}

template <class AnyIterate>
void print_result(const AnyIterate& x, const TimedReport& report, const SolveRequest& request)
{
    const ErrorMeasures errors = measure_errors(x);
    say("sweeps: {}\nresidual: {:.3g}, tolerance {:.3g}{}\n", report.sweeps, errors.natural_map,
        request.settings.tolerance, report.converged ? "" : ": NOT MET");
    say("worst velocity error: {:.3g}", errors.worst_velocity_error);
    if (errors.worst_spin_error > 0.0) say(", worst spin error: {:.3g}", errors.worst_spin_error);
    say("\nworst cone violation: {:.3g}\n", errors.cone_violation);
    if (report.running_error)
        say("energy error left, as the sweeps foretell: {:.3g}; the note's running error: {:.3g}\n",
            report.running_error->energy_left(), report.running_error->of_note);
    const double updates = static_cast<double>(x.constraints().size()) * report.sweeps;
    say("seconds: {:.4g}\ncontact updates per second: {:.3g}\n", report.seconds,
        report.seconds > 0.0 ? updates / report.seconds : 0.0);
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

/// Why a solve did not meet its tolerance.
std::string complaint(const TimedReport& report)
{
    if (!report.finite)
        return fmt::format(
            "the sweeps diverge: an impulse was not a number after {}; nothing is written", report.sweeps);
    if (report.growing)
        return fmt::format(
            "the impulses have grown for {} sweeps and the laws are broken as before: there may be no solution",
            report.sweeps);
    return fmt::format("the tolerance was not met in {} sweeps", report.sweeps);
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
    if (speaks) print_result(x, report, line.solve);
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
    for (const auto& path : {request.history, line.out}) {
        if (!path.empty() && fs::exists(path) && fs::exists(request.problem) && fs::equivalent(path, request.problem))
            throw UsageError(fmt::format("{} is the problem itself; name another file for the result", path.string()));
        if (!path.empty()) require_writable(path);
    }
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
