// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"
#include "app/system/exit_code.hpp"

namespace talus
{

/// Goes on with the run in the folder that the command line names, from its checkpoint, bit for bit as if it had never
/// stopped.
/// @returns as run_scene does
/// @throws InputError where there is no such run, no checkpoint that can be used, or another scene; OutputError
ExitCode resume_run(const CommandLine& line);

} // namespace talus
