// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// Brings a case of a sweep to its end, whatever has become of it so far, so that any queue may call it as often as it
/// likes: what is done or has failed stays, a run with a checkpoint goes on, any other begins anew. Waits while another
/// process runs the case.
/// @returns done where the case has its result, which may be that it failed; else as run_scene does
/// @throws InputError where there is no such case, or its folder holds another run; UsageError, OutputError
ExitCode run_case(const CommandLine& line);

} // namespace talus
