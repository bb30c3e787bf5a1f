// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace talus
{

/// What a trial may use.
struct TrialLimits {
    int seconds;        ///< CPU time, at least 1
    std::size_t memory; ///< beyond what the process has already [B]
};

/// Tries `act` in a copy of this process (fork) that is gone afterwards: for libraries that a broken file may crash, or
/// make ask for far too much. Nothing that they do there reaches this process, and what they print to standard error is
/// not seen.
/// @param crashed sentence where the copy crashes or exceeds its time
/// @throws InputError as `act` does there, or with `crashed`; std::system_error where there can be no copy
void try_in_a_copy(const std::function<void()>& act, const TrialLimits& limits, const std::string& crashed);

} // namespace talus
