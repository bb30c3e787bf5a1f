// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_scene.hpp"

#include "app/check_scene.hpp"
#include "app/open_scene.hpp"
#include "app/run_loop.hpp"
#include "app/run_report.hpp"
#include "io/scene_file.hpp"
#include "io/summary.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

/// Incidents told on standard error; all of them are in the summary.
constexpr std::size_t incidents_told = 5;

void print_start(const OpenedScene& opened, Verbosity verbosity, const fs::path& folder)
{
    if (verbosity == Verbosity::quiet) return;
    const Simulation& simulation = opened.simulation;
    if (verbosity == Verbosity::verbose) {
        print_scene(opened);
    } else {
        fmt::print("{}: {}\n", opened.name, opened.scene.title);
        print_explanations(simulation);
    }
    fmt::print("threads: {}\noutput: {}\n", omp_get_max_threads(), folder.string());
    std::fflush(stdout); // before progress appears on standard error
}

void print_incidents(const RunSummary& summary)
{
    const std::size_t told = std::min(summary.incidents.size(), incidents_told);
    for (std::size_t k = 0; k < told; ++k)
        fmt::print(
            stderr, "t = {:.6g} s: {}\n", summary.simulated_time, describe(summary.incidents[k], summary.wall_names));
    if (summary.incidents.size() > told)
        fmt::print(stderr, "and {} more, see summary.json\n", summary.incidents.size() - told);
}

} // namespace

ExitCode run_scene(const CommandLine& line)
{
    OpenedScene opened = open_scene(line);
    if (line.threads > 0) omp_set_num_threads(line.threads);
    const fs::path folder = line.out.empty() ? fs::path("out") / opened.name : line.out;
    make_run_folder(folder, resolved_scene(opened.scene), line.force);
    print_start(opened, line.verbosity, folder);

    Progress progress(line.verbosity, opened.simulation.duration);
    RunLoop loop(opened.simulation, opened.scene, folder, progress);
    const std::vector<Incident> incidents = loop.run();

    const RunSummary summary = summarise(opened, loop, incidents);
    write_summary(folder / "summary.json", summary);
    if (line.verbosity != Verbosity::quiet) print_results(summary);
    print_incidents(summary);
    return incidents.empty() ? ExitCode::done : ExitCode::physics;
}

} // namespace talus
