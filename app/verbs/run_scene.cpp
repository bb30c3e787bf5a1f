// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/run_scene.hpp"

#include "app/loop/open_scene.hpp"
#include "app/loop/run_loop.hpp"
#include "app/system/signals.hpp"
#include "app/system/terminal.hpp"
#include "app/verbs/check_scene.hpp"
#include "app/verbs/relaxation.hpp"
#include "app/verbs/run_end.hpp"
#include "io/scene/scene_file.hpp"

#include <omp.h>

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

void print_relaxation(const Relaxation& relaxation, const OverlapCheck& before, double d)
{
    say("relaxed in {} steps: {} overlaps, the worst {:.2g} % d, became {}, the worst {:.2g} % d\n", relaxation.steps,
        before.count, 100.0 * before.worst / d, relaxation.left.count, 100.0 * relaxation.left.worst / d);
}

void advise_to_relax(const OverlapCheck& overlaps, double d)
{
    if (overlaps.worst > notable_overlap * d)
        warn("{} contacts overlap at the start, the worst by {:.2g} % d; --relax moves the spheres apart first\n",
            overlaps.count, 100.0 * overlaps.worst / d);
}

} // namespace

ExitCode run_scene(const CommandLine& line)
{
    OpenedScene opened = open_scene(line);
    if (line.threads > 0) omp_set_num_threads(line.threads);
    const fs::path folder = line.out.empty() ? fs::path("out") / opened.name : line.out;
    make_run_folder(folder, resolved_scene(opened.scene), line.force);
    catch_signals();

    const OverlapCheck overlaps = check_overlaps(opened.simulation);
    const double d = opened.simulation.model.mean_diameter;
    const bool speaks = line.verbosity != Verbosity::quiet;
    if (speaks) print_start(opened, overlaps, line.verbosity, folder);
    if (line.relax) {
        const Relaxation relaxation = relax_overlaps(opened.simulation, overlaps);
        if (speaks) print_relaxation(relaxation, overlaps, d);
    } else if (speaks) {
        advise_to_relax(overlaps, d);
    }

    RunLoop loop(opened, folder, line.verbosity);
    return run_to_end(opened, loop, folder, line.verbosity);
}

} // namespace talus
