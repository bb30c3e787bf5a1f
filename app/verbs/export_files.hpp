// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// `talus export`: writes the frames of a run in another format, or a scene as a deck for another program, and says
/// what that leaves out.
/// @throws UsageError, InputError, OutputError
ExitCode export_files(const CommandLine& line);

} // namespace talus
