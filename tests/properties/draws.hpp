// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/properties/draw.hpp"

#include <cstdio>
#include <functional>
#include <optional>
#include <string>

namespace talus::test
{

/// What a world did wrong, with the few lines that describe it; nothing where all was right.
using Fault = std::optional<std::string>;

/// Draws a share of the worlds that a property has, 1000 or TALUS_PROPERTIES_COUNT, with the seeds from 1 or
/// TALUS_PROPERTIES_SEED on. Fails with the number of those that were wrong, and seed and description of the first few:
/// TALUS_PROPERTIES_TELL (3).
/// @param share 1, less where a world costs more; @param world makes one, runs it and judges it
void for_all_worlds(double share, const std::function<Fault(Draw&)>& world);

/// As printf has it.
template <class... Numbers> std::string text(const char* format, Numbers... numbers)
{
    char buffer[600];
    std::snprintf(buffer, sizeof buffer, format, numbers...);
    return buffer;
}

} // namespace talus::test
