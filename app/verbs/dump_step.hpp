// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// `talus dump`: runs a scene up to a time and writes the contact problem of the step that follows.
/// @throws UsageError, InputError, OutputError
ExitCode dump_step(const CommandLine& line);

} // namespace talus
