// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/run_scene.hpp"

#include "app/loop/run_loop.hpp"
#include "app/loop/run_origin.hpp"
#include "app/loop/run_report.hpp"
#include "app/system/own_files.hpp"
#include "app/system/script.hpp"
#include "app/system/signals.hpp"
#include "app/system/threads.hpp"
#include "app/verbs/check_scene.hpp"
#include "app/verbs/run_page.hpp"
#include "core/step/relaxation.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/summary.hpp"
#include "io/text/input_error.hpp"

#include <omp.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

/// From which overlap on a start is likely to burst [d].
constexpr double notable_overlap = 0.01;

void print_start(const OpenedScene& opened, const OverlapCheck& overlaps, Verbosity verbosity, const fs::path& folder)
{
    if (verbosity == Verbosity::verbose) {
        print_scene(opened, overlaps);
    } else {
        say("{}: {}\n", opened.name, opened.scene.title);
        print_explanations(opened, overlaps);
    }
    say("threads: {}\noutput: {}\n", omp_get_max_threads(), folder.string());
}

void print_relaxation(int steps, const OverlapCheck& before, const OverlapCheck& left, double d)
{
    say("relaxed in {} steps: {} overlaps, the worst {:.2g} % d, became {}, the worst {:.2g} % d\n", steps,
        before.count, 100.0 * before.worst / d, left.count, 100.0 * left.worst / d);
}

void advise_to_relax(const OverlapCheck& overlaps, double d)
{
    if (overlaps.worst > notable_overlap * d)
        warn("{} contacts overlap at the start, the worst by {:.2g} % d; --relax moves the spheres apart first\n",
            overlaps.count, 100.0 * overlaps.worst / d);
}

/// Incidents told on standard error; all of them are in the summary.
constexpr std::size_t incidents_told = 5;

/// How to avoid an incident, and how a run can go on after it, where there is a way.
std::string way_past(const Incident& incident, const fs::path& folder, const std::string& world)
{
    if (incident.kind == Incident::Kind::pressed)
        return fmt::format(
            "; to go on all the same: talus resume {} --set solver.on_no_solution=go_on", folder.string());
    if (incident.kind != Incident::Kind::escaped) return "";
    const std::string wider = fmt::format("; the world is {}: make it larger with [world] 'min' and 'max'", world);
    if (incident.of_piston()) return wider;
    return fmt::format("{}, give an [[outlet]] where spheres may leave, or go on without this one: talus resume {} "
                       "--set world.on_escape=remove",
        wider, folder.string());
}

void print_incidents(const RunSummary& summary, const fs::path& folder, const std::string& world)
{
    const std::size_t told = std::min(summary.incidents.size(), incidents_told);
    for (std::size_t k = 0; k < told; ++k)
        warn("t = {:.6g} s: {}{}\n", summary.simulated_time, describe(summary.incidents[k], summary.wall_names),
            k == 0 ? way_past(summary.incidents[k], folder, world) : "");
    if (summary.incidents.size() > told) warn("and {} more, see summary.json\n", summary.incidents.size() - told);
}

/// Names the command that makes a picture of the run, by the shorter of its paths.
void advise_to_look(const fs::path& folder)
{
    const fs::path script = own_files() / "postprocess" / "render.py";
    std::error_code error;
    if (!fs::exists(script, error)) return;
    const std::string from_here = fs::proximate(script, error).string();
    say("to see it: {} {}\n", from_here.size() < script.string().size() ? from_here : script.string(), folder.string());
}

/// Shows the run in a browser until it is over, where that is asked for and can be done.
std::unique_ptr<ScriptBeside> watch_beside(const CommandLine& line, const fs::path& folder)
{
    if (!line.watch) return nullptr;
    try {
        return std::make_unique<ScriptBeside>(
            "watch.py", std::vector<std::string>{"--until-it-is-over", "--", folder.string()});
    } catch (const UsageError& error) {
        warn("the run goes on, but cannot be watched: {}\n", error.what());
        return nullptr;
    }
}

/// Runs to the end. What cannot be written since the folder has gone meanwhile says so, whichever file it is.
RunEnd run_in_its_folder(RunLoop& loop, FolderLock& lock)
{
    try {
        return loop.run();
    } catch (const OutputError&) {
        lock.hold();
        throw;
    }
}

/// Runs what is ready to run, writes summary.json and tells how it went. The page comes last: it takes seconds, and
/// whoever does not want to wait for it ends the program with a second Ctrl-C.
ExitCode run_to_end(const OpenedScene& opened, RunLoop& loop, const CommandLine& line, FolderLock& lock)
{
    const fs::path folder = lock.folder();
    if (line.error_estimate) loop.estimate_error();
    const auto watcher = watch_beside(line, folder);
    const RunEnd end = run_in_its_folder(loop, lock);
    const RunSummary summary = summarise(opened, loop.statistics(), loop.clock(), end.incidents);
    lock.hold();
    write_summary(folder / "summary.json", summary);
    if (line.verbosity != Verbosity::quiet) print_results(summary);
    print_incidents(summary, folder, opened.report.world);
    const bool stopped = end.incidents.empty() && end.signal != 0;
    if (stopped)
        warn("stopped by SIG{} at t = {:.6g} s after a checkpoint; to go on: talus resume {}\n",
            sigabbrev_np(end.signal), summary.simulated_time, folder.string());
    if (line.report) make_page(folder, line.verbosity);
    if (!end.incidents.empty()) return ExitCode::physics;
    if (stopped) return stopped_by(end.signal);
    if (line.verbosity != Verbosity::quiet) advise_to_look(folder);
    return ExitCode::done;
}

fs::path scene_of_run(const fs::path& folder)
{
    const fs::path scene = folder / "scene.resolved.toml";
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw InputError(fmt::format("{}: there is no such folder", folder.string()));
    if (!fs::exists(scene)) throw InputError(fmt::format("{}: the folder holds no run of Talus", folder.string()));
    return scene;
}

void print_resumption(const OpenedScene& opened, const Checkpoint& checkpoint, const CommandLine& line)
{
    if (!checkpoint.newer_is_broken.empty())
        warn("{}; going on from the one before it, {}\n", checkpoint.newer_is_broken, checkpoint.path.string());
    if (line.verbosity == Verbosity::quiet) return;
    const State& state = opened.simulation.state;
    say("{}: {}\n", opened.name, opened.scene.title);
    say("resumed from {} at t = {:.6g} s, step {}, with {} spheres\n", checkpoint.path.string(), state.time,
        state.steps, state.count());
    say("threads: {}\noutput: {}\n", omp_get_max_threads(), line.out.string());
}

} // namespace

ExitCode run_scene(const CommandLine& line)
{
    return run_opened(open_scene(line), line);
}

ExitCode run_opened(OpenedScene opened, const CommandLine& line)
{
    use_threads(line.threads);
    const fs::path folder = line.out.empty() ? fs::path("out") / opened.name : line.out;
    const auto files = named_files(opened.scene);
    FolderLock lock =
        make_run_folder(folder, resolved_scene(with_copies(opened.scene, files)), line.force, inputs_of(opened, files));
    copy_files(files, folder);
    warn_unless_protected(lock);
    catch_signals();

    const OverlapCheck overlaps = check_overlaps(opened.simulation);
    const double d = opened.simulation.model.mean_diameter;
    const bool speaks = line.verbosity != Verbosity::quiet;
    if (speaks) print_start(opened, overlaps, line.verbosity, folder);
    if (line.relax) {
        const int steps = relax_overlaps(opened.simulation.state, opened.simulation.model, overlaps.worst);
        if (speaks) print_relaxation(steps, overlaps, check_overlaps(opened.simulation), d);
    } else if (speaks) {
        advise_to_relax(overlaps, d);
    }

    RunLoop loop(opened, lock, line.verbosity);
    return run_to_end(opened, loop, line, lock);
}

ExitCode resume_run(const CommandLine& line)
{
    const fs::path scene = scene_of_run(line.out);
    FolderLock lock(line.out);
    warn_unless_protected(lock);
    Checkpoint checkpoint = read_checkpoint(line.out, TALUS_VERSION);
    use_threads(line.threads);
    try {
        Archive archive(std::move(checkpoint.state));
        RunOrigin origin;
        archive(origin);
        SceneFile file = read_scene_as_asked(scene, line);
        refuse_other_scene(file, origin);
        OpenedScene opened = build_opened(std::move(file), origin.scene_name);
        catch_signals();

        RunLoop loop(opened, lock, line.verbosity, archive);
        write_atomically(scene, resolved_scene(with_copies(opened.scene, named_files(opened.scene))));
        fs::remove(line.out / "summary.json"); // of a run that had ended; this one has not
        print_resumption(opened, checkpoint, line);
        return run_to_end(opened, loop, line, lock);
    } catch (const ArchiveError& error) {
        throw InputError(fmt::format(
            "{}: cannot be put back, as by another build of Talus: {}", checkpoint.path.string(), error.what()));
    }
}

} // namespace talus
