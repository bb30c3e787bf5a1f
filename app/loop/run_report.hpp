// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"
#include "app/loop/run_loop.hpp"
#include "io/run/summary.hpp"

namespace talus
{

/// Puts together what is left to say of a run that is over.
RunSummary summarise(const OpenedScene& opened, const RunLoop& loop, const RunEnd& end);

/// Prints the summary as a table: sensors, particle ledger, error, time per phase.
void print_results(const RunSummary& summary);

} // namespace talus
