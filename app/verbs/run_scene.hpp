// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// Runs the scene that the command line names, from its file to summary.json.
/// @returns done, physics where an incident ended the run, interrupted or terminated where a signal did
/// @throws UsageError, InputError, OutputError
ExitCode run_scene(const CommandLine& line);

/// Runs a scene that is open, into the folder that the command line names.
/// @returns, @throws as run_scene does
ExitCode run_opened(OpenedScene opened, const CommandLine& line);

/// Goes on with the run in the folder that the command line names, from its checkpoint, bit for bit as if it had never
/// stopped.
/// @returns as run_scene does
/// @throws InputError where there is no such run, no checkpoint that can be used, or another scene; OutputError
ExitCode resume_run(const CommandLine& line);

} // namespace talus
