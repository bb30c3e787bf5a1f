// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

namespace talus
{

/// Runs a scene under many settings from the same state, measures the error of each against a reference and its cost,
/// and writes rows.jsonl (a line as soon as a run is done), study.csv and study.html into the study's folder. A study
/// that was stopped goes on where it was when it is asked for again.
/// @throws InputError, UsageError, OutputError
ExitCode study_scene(const CommandLine& line);

} // namespace talus
