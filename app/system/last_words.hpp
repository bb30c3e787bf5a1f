// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>

namespace talus
{

/// From now on a crash of the program ends it with one sentence on standard error and the exit code of a fault of
/// Talus.
void catch_crashes();

/// Keeps for the last words of a program that comes to a sudden end how the run in this folder can go on.
/// @param checkpoint time of the last checkpoint [s]; nothing: there is none yet
void note_checkpoint(const std::filesystem::path& folder, std::optional<double> checkpoint);

/// How the run can go on, as the end of a sentence: "; the last checkpoint in out is of t = 0.1 s; to go on: talus
/// resume out". Empty where there is no run.
const char* way_on();

/// Writes the parts of a sentence and how the run can go on to standard error, past all buffers: for handlers of
/// signals, so it takes no memory and no lock.
void say_last_words(std::initializer_list<const char*> sentence);

} // namespace talus
