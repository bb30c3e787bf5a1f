// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"
#include "app/loop/run_loop.hpp"
#include "io/run/summary.hpp"

namespace talus
{

/// Puts together what there is to say of a run that is over, or as far as it has come.
/// @param incidents that ended it; empty where none did
RunSummary summarise(const OpenedScene& opened, const RunStatistics& statistics, const PhaseClock& clock,
    const std::vector<Incident>& incidents);

/// Prints the summary as a table: sensors, particle ledger, error, time per phase.
void print_results(const RunSummary& summary);

} // namespace talus
