// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace talus
{

struct TriangleSoup {
    std::vector<Vec3> vertices; ///< equal corners merged
    std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Reads an STL file, ASCII or binary.
/// @throws InputError where the file is missing, truncated, empty or not STL, or has a coordinate that is not a number.
TriangleSoup read_stl(const std::filesystem::path& path);

} // namespace talus
