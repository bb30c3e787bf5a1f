// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/solve_report.hpp"

#include "app/system/terminal.hpp"

#include <algorithm>

namespace talus
{

using namespace multibody;

namespace
{

using Eigen::Index;

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

} // namespace

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

template <class AnyIterate> void print_result(const AnyIterate& x, const TimedReport& report, double tolerance)
{
    const ErrorMeasures errors = measure_errors(x);
    say("sweeps: {}\nresidual: {:.3g}, tolerance {:.3g}{}\n", report.sweeps, errors.natural_map, tolerance,
        report.converged ? "" : ": NOT MET");
    say("worst velocity violation: {:.3g}", errors.worst_velocity_violation);
    if (errors.worst_spin_violation > 0.0) say(", worst spin violation: {:.3g}", errors.worst_spin_violation);
    say("\nworst cone violation: {:.3g}\n", errors.cone_violation);
    if (report.running_error)
        say("energy error left, as the sweeps foretell: {:.3g}; the note's running error: {:.3g}\n",
            report.running_error->energy_left(), report.running_error->of_note);
    const double updates = static_cast<double>(x.constraints().size()) * report.sweeps;
    say("seconds: {:.4g}\ncontact updates per second: {:.3g}\n", report.seconds,
        report.seconds > 0.0 ? updates / report.seconds : 0.0);
}

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

template void print_result(const Iterate&, const TimedReport&, double);
template void print_result(const AssembledIterate&, const TimedReport&, double);

} // namespace talus
