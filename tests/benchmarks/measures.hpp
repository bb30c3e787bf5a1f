// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/median.hpp"

#include <chrono>
#include <ctime>
#include <vector>

namespace talus::bench
{

/// Seconds of a clock [s].
inline double wall_seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of the processor, of all threads: what others on the machine do counts less than with a clock.
inline double cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// How many of two processors others leave to us: what two threads get that do nothing but count, for a tenth of a
/// second.
double free_processors();

/// Whether figures of two threads mean anything now: on a busy machine threads wait for each other many times as long.
bool two_are_free();

// Each adds its benchmarks to those of the program.
void register_triad(const char* moment);
void register_sweeps();
void register_steps();
void register_files();

} // namespace talus::bench
