// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// `talus solve`: reads a contact problem, solves it with the general Gauss–Seidel methods, says how it went, and
/// writes the solution, met tolerance or not.
/// @throws UsageError, InputError, OutputError
ExitCode solve_problem(const CommandLine& line);

} // namespace talus
