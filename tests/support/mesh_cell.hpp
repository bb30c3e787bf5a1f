// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace talus::test
{

/// Appends the two triangles of a square cell of a lattice whose corners are a, b, c and d, in this order round it.
/// @param diagonals "rising" (from a to c), "falling" (from b to d), or "mixed", in turn
/// @param i, j which cell it is
inline void add_cell(std::vector<std::array<std::int32_t, 3>>& triangles, const std::array<std::int32_t, 4>& corners,
    const std::string& diagonals, int i, int j)
{
    const auto [a, b, c, d] = corners;
    if (diagonals == "rising" || (diagonals == "mixed" && (i + j) % 2 == 0)) {
        triangles.push_back({a, b, c});
        triangles.push_back({c, d, a});
    } else {
        triangles.push_back({a, b, d});
        triangles.push_back({c, d, b});
    }
}

} // namespace talus::test
