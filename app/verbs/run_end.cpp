// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/run_end.hpp"

#include "app/loop/run_report.hpp"
#include "app/system/terminal.hpp"
#include "io/run/summary.hpp"

#include <algorithm>
#include <csignal>

namespace talus
{
namespace
{

/// Incidents told on standard error; all of them are in the summary.
constexpr std::size_t incidents_told = 5;

void print_incidents(const RunSummary& summary)
{
    const std::size_t told = std::min(summary.incidents.size(), incidents_told);
    for (std::size_t k = 0; k < told; ++k)
        warn("t = {:.6g} s: {}\n", summary.simulated_time, describe(summary.incidents[k], summary.wall_names));
    if (summary.incidents.size() > told) warn("and {} more, see summary.json\n", summary.incidents.size() - told);
}

} // namespace

ExitCode run_to_end(const OpenedScene& opened, RunLoop& loop, const std::filesystem::path& folder, Verbosity verbosity)
{
    const RunEnd end = loop.run();
    const RunSummary summary = summarise(opened, loop, end);
    write_summary(folder / "summary.json", summary);
    if (verbosity != Verbosity::quiet) print_results(summary);
    print_incidents(summary);
    if (!end.incidents.empty()) return ExitCode::physics;
    if (end.signal == 0) return ExitCode::done;
    warn("stopped by {} at t = {:.6g} s after a checkpoint; to go on: talus resume {}\n",
        end.signal == SIGINT ? "SIGINT" : "SIGTERM", summary.simulated_time, folder.string());
    return end.signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
}

} // namespace talus
