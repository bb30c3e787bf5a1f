// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"

namespace talus::test
{

inline Region box(const Vec3& min, const Vec3& max)
{
    Region region;
    region.box = {min, max};
    return region;
}

/// @param axis unit
inline Region cylinder(const Vec3& base, const Vec3& axis, double radius, double height)
{
    Region region;
    region.shape = Region::Shape::cylinder;
    region.base = base;
    region.axis = axis;
    region.radius = radius;
    region.height = height;
    return region;
}

} // namespace talus::test
