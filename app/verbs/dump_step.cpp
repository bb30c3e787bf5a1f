// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/dump_step.hpp"

#include "app/loop/open_scene.hpp"
#include "app/loop/progress.hpp"
#include "app/system/phase_clock.hpp"
#include "app/system/terminal.hpp"
#include "core/solver/step_problem.hpp"
#include "io/problem/fclib_problem.hpp"
#include "io/run/run_files.hpp"
#include "scenarios/build/checks.hpp"

#include <omp.h>

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

} // namespace

ExitCode dump_step(const CommandLine& line)
{
    OpenedScene opened = open_scene(line);
    require_writable(line.out, line.force);
    if (line.threads > 0) omp_set_num_threads(line.threads);
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
    file.description = fmt::format(
        "Talus {}, contact problem of the step of {:.6g} s from t = {:.9g} s on, seed {}; SI units, impulses in N s. "
        "Bodies: the spheres with (v, r omega), pistons with (v, omega), then one for each compliance. Guess 1 has the "
        "impulses carried over from the step before.",
        TALUS_VERSION, simulation.model.time_step, simulation.state.time, opened.scene.seed);
    write_fclib(file, line.out);
    if (line.verbosity != Verbosity::quiet)
        say("{}: {} contacts, {} spheres, t = {:.6g} s\n", line.out.string(), file.contacts(), simulation.state.count(),
            simulation.state.time);
    return ExitCode::done;
}

} // namespace talus
