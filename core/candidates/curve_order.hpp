// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// How far along Hilbert's curve through all space the cube lies that holds this place: neighbours on it are neighbours
/// in space. The cubes begin at `corner`; beyond 2^20 of them in one direction all are one.
/// J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707 (2004) 381.
std::uint64_t curve_key(const Vec3& place, const Vec3& corner, double edge);

/// The places of spheres along the curve: sphere i comes at position order[i]. It depends on nothing else than the
/// keys, and on the ids where these are the same.
std::vector<std::int32_t> curve_order(const std::vector<std::uint64_t>& key, const std::vector<std::int64_t>& id);

} // namespace talus
