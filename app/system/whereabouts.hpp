// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/system/phase_clock.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

/// Where the run of this process is: noted as it goes, so that the last words of one that crashes can tell it. All of
/// it may be asked for in a handler of signals: nothing here takes memory or a lock.
namespace talus
{

void note_run(const std::filesystem::path& folder); ///< begins, or goes on, in this folder
void note_step(std::int64_t step, double time);     ///< is begun; time at its begin [s]
void note_phase(RunPhase phase);
void note_checkpoint(double time); ///< is on the disk [s]

/// A text of limited length, put together without taking memory; what does not fit is left out.
class ShortText
{
public:
    ShortText& operator<<(std::string_view text);
    ShortText& operator<<(double number); ///< six digits
    ShortText& operator<<(std::int64_t number);

    std::string_view view() const { return {text_.data(), size_}; }

private:
    std::array<char, 2048> text_;
    std::size_t size_ = 0;
};

/// Adds where the run is and how to go on, as the end of a sentence: ", at t = 0.1 s, in step 812 (sweeps); …". Nothing
/// where there is no run.
void add_whereabouts(ShortText& text);

/// Writes this and where the run is to standard error, past all buffers: for handlers that end the program.
void say_last_words(ShortText& text);

} // namespace talus
