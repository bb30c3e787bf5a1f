// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// The places of points along a space-filling curve: point i comes at position order[i]. Neighbours on the curve are
/// neighbours in space, so a sweep that follows it stays in the cache.
std::vector<std::int32_t> curve_order(const std::vector<Vec3>& points);

} // namespace talus
