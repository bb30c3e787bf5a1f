// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/resume_run.hpp"

#include "app/loop/open_scene.hpp"
#include "app/loop/run_loop.hpp"
#include "app/loop/run_origin.hpp"
#include "app/system/signals.hpp"
#include "app/system/terminal.hpp"
#include "app/verbs/run_end.hpp"
#include "io/run/checkpoint.hpp"
#include "io/text/input_error.hpp"

#include <omp.h>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

fs::path scene_of_run(const fs::path& folder)
{
    const fs::path scene = folder / "scene.resolved.toml";
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw InputError(fmt::format("{}: there is no such folder", folder.string()));
    if (!fs::exists(scene, error))
        throw InputError(fmt::format("{}: the folder holds no run of Talus", folder.string()));
    return scene;
}

void print_start(const OpenedScene& opened, const Checkpoint& checkpoint, const CommandLine& line)
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

ExitCode resume_run(const CommandLine& line)
{
    const fs::path scene = scene_of_run(line.out);
    Checkpoint checkpoint = read_checkpoint(line.out, TALUS_VERSION);
    if (line.threads > 0) omp_set_num_threads(line.threads);
    try {
        Archive archive(std::move(checkpoint.state));
        RunOrigin origin;
        archive(origin);
        SceneFile file = read_scene_as_asked(scene, line);
        refuse_other_scene(file, origin);
        OpenedScene opened = build_opened(std::move(file), origin.scene_name);
        catch_signals();

        RunLoop loop(opened, line.out, line.verbosity, archive);
        write_atomically(scene, resolved_scene(opened.scene));
        fs::remove(line.out / "summary.json"); // of a run that had ended; this one has not
        print_start(opened, checkpoint, line);
        return run_to_end(opened, loop, line.out, line.verbosity);
    } catch (const ArchiveError& error) {
        throw InputError(fmt::format(
            "{}: cannot be put back, as by another build of Talus: {}", checkpoint.path.string(), error.what()));
    }
}

} // namespace talus
