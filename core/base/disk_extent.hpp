// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

namespace talus
{

/// Half of the size, along each coordinate, of a disk of radius 1 at right angles to a unit axis.
inline Vec3 disk_half_extent(const Vec3& axis)
{
    return (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

} // namespace talus
