// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace talus
{

/// Runs task(0) … task(count − 1), so many at a time, each in a copy of this process (fork) on one thread that is gone
/// afterwards: one that crashes takes nothing with it.
/// @param done called here with what a task returned, or with "" and how it ended where it returned nothing; tasks end
///   in any order
/// @param go_on asked before each task; what runs is ended where it says no
/// @throws std::system_error where there can be no copy
void run_in_copies(std::size_t count, int at_once, const std::function<std::string(std::size_t)>& task,
    const std::function<void(std::size_t task, const std::string& words, const std::string& ending)>& done,
    const std::function<bool()>& go_on);

} // namespace talus
