// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// Writes a scene to start from: the commented one of scenarios/templates, or a copy of a supplied one and of the files
/// that it names. Nothing that is there is replaced.
/// @throws UsageError where there is no such scene; InputError where a file is there already; OutputError
void new_scene(const CommandLine& line);

} // namespace talus
