// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/dump_step.hpp"

#include "app/loop/open_scene.hpp"
#include "app/loop/progress.hpp"
#include "app/system/phase_clock.hpp"
#include "app/system/terminal.hpp"
#include "app/system/threads.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "core/solver/step_problem.hpp"
#include "io/problem/fclib_problem.hpp"
#include "io/run/run_files.hpp"
#include "scenarios/builder/checks.hpp"

namespace talus
{
namespace
{

/// Steps to the first step that begins at or after this time. Returns the report of the last one.
StepReport step_until(Simulation& simulation, double time, Verbosity verbosity)
{
    const PhaseClock clock;
    Progress progress(verbosity, simulation);
    const auto show = [&](const StepReport& report) { progress.update(simulation, report, clock.wall()); };
    const StepReport last = run_until(simulation, time, {.after_step = show});
    progress.finish();
    return last;
}

/// Where bodies and contacts come from, as `origin_lists` says.
std::map<std::string, Eigen::VectorXd> origin_of(const StepProblem& step, const State& state)
{
    std::map<std::string, std::vector<double>> lists;
    const auto add = [&](const std::string& list, auto... numbers) {
        (lists[list].push_back(static_cast<double>(numbers)), ...);
    };
    for (const std::size_t sphere : step.sphere_of_body) {
        const Vec3& x = state.position[sphere];
        add("bodies/id", state.id[sphere]);
        add("bodies/radius", state.radius[sphere]);
        add("bodies/position", x.x(), x.y(), x.z());
    }
    for (const ContactOrigin& contact : step.contacts) {
        add("contacts/id_a", state.id[contact.a]);
        add("contacts/id_b", contact.with_wall ? -1 : state.id[contact.b]);
        add("contacts/wall", contact.with_wall ? contact.b : -1);
        add("contacts/gap", contact.gap);
        add("contacts/kind", contact.kind);
        add("contacts/point", contact.point.x(), contact.point.y(), contact.point.z());
    }
    std::map<std::string, Eigen::VectorXd> origin;
    for (const auto& [list, numbers] : lists)
        origin[list] = Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    return origin;
}

/// The options with which `talus solve` sweeps the problem as the run would.
std::string options_of_run(const Model& model)
{
    const SolverSettings& solver = model.solver;
    std::string omega;
    for (int sweep = 0; sweep <= solver.min_sweeps; ++sweep)
        omega += fmt::format("{}{}", sweep > 0 ? "," : "", relaxation_of(sweep, model.physics, solver));
    return fmt::format(
        "--guess 1 --omega {} --tolerance {} --max-sweeps {}", omega, solver.tolerance, solver.max_sweeps);
}

} // namespace

ExitCode dump_step(const CommandLine& line)
{
    OpenedScene opened = open_scene(line);
    if (line.at > opened.scene.time.duration)
        throw UsageError(
            fmt::format("--at {:g} is after the end of the scene, {:g} s: give an earlier time, or a longer "
                        "'duration' with --set time.duration=",
                line.at, opened.scene.time.duration));
    if (opened.simulation.model.physics.twisting)
        throw InputError("the scene has twisting_friction, for which FCLIB has no row: nothing is written");
    require_writable(line.out, line.force, inputs_of(opened, named_files(opened.scene)));
    use_threads(line.threads);
    Simulation& simulation = opened.simulation;
    simulation.duration = line.at; // as far as the progress line goes
    const StepReport last = step_until(simulation, line.at, line.verbosity);
    if (simulation.incident_policy.stops(last)) {
        warn("t = {:.6g} s: {}; nothing is written\n", simulation.state.time,
            describe(last.bodies.incidents.front(), names_of(simulation.model.walls)));
        return ExitCode::physics;
    }

    prepare_step(simulation);
    const StepProblem step = make_step_problem(simulation.state, simulation.network, simulation.model);
    FclibProblem file = to_fclib(step.problem, step.warm_impulse);
    file.title = fmt::format("{}: {}", opened.name, opened.scene.title);
    const std::string as_run = options_of_run(simulation.model);
    file.description = fmt::format(
        "Talus {}, contact problem of the step of {:.6g} s from t = {:.9g} s on, seed {}; SI units, impulses in N s. "
        "Bodies: the spheres by id with (v, r omega), pistons with (v, omega), then one for each compliance. Guess 1 "
        "has the impulses carried over from the step before. Contacts come in the order of the run's sweeps, which are "
        "those of: talus solve {}; after them come {} without friction, which keep compliant ones from parting faster "
        "than they may.",
        TALUS_VERSION, simulation.model.time_step, simulation.state.time, opened.scene.seed, as_run,
        file.contacts() - static_cast<Eigen::Index>(step.contacts.size()));
    file.origin = origin_of(step, simulation.state);
    write_fclib(file, line.out);
    if (line.verbosity != Verbosity::quiet)
        say("{}: {} contacts, {} spheres, t = {:.6g} s\n", line.out.string(), file.contacts(), simulation.state.count(),
            simulation.state.time);
    if (line.verbosity != Verbosity::quiet)
        say("to sweep it as the run does: talus solve {} {}\n", line.out.string(), as_run);
    return ExitCode::done;
}

} // namespace talus
