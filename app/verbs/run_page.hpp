// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// `talus report`: becomes the script that makes a page which plays a run.
/// @throws UsageError where that cannot be started
ExitCode report_run(const CommandLine& line);

/// `talus watch`: becomes the script that shows a run in a browser while it goes on.
/// @throws UsageError where that cannot be started
ExitCode watch_run(const CommandLine& line);

/// Makes the page of a run that is over, and names it; where that fails, one sentence says so.
void make_page(const std::filesystem::path& folder, Verbosity verbosity);

} // namespace talus
