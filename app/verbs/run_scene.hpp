// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"
#include "app/system/exit_code.hpp"

namespace talus
{

/// Runs the scene that the command line names, from its file to summary.json.
/// @returns done, physics where an incident ended the run, interrupted or terminated where a signal did
/// @throws UsageError, InputError, OutputError
ExitCode run_scene(const CommandLine& line);

} // namespace talus
