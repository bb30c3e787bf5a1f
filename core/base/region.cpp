// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"

#include <cmath>
#include <numbers>

namespace talus
{

bool Region::contains(const Vec3& x, double ball_radius) const
{
    if (shape == Shape::box) return box.grown(-ball_radius).contains(x);
    const double along = (x - base).dot(axis);
    const double out = (x - base - along * axis).norm();
    return along >= ball_radius && along <= height - ball_radius && out <= radius - ball_radius;
}

Box Region::bounds() const
{
    if (shape == Shape::box) return box;
    const Vec3 half = radius * disk_half_extent(axis);
    Box result;
    for (const Vec3& end : {base, Vec3(base + height * axis)}) result.extend(Box{end - half, end + half});
    return result;
}

bool Region::fits(double ball_radius) const
{
    if (shape == Shape::box) return !box.grown(-ball_radius).empty();
    return radius >= ball_radius && height >= 2.0 * ball_radius;
}

Vec3 Region::random_point(Random& random, double ball_radius) const
{
    if (shape == Shape::box) {
        const Box inner = box.grown(-ball_radius);
        Vec3 x;
        for (int d = 0; d < 3; ++d) x[d] = inner.min[d] + uniform(random) * (inner.max[d] - inner.min[d]);
        return x;
    }
    const double out = (radius - ball_radius) * std::sqrt(uniform(random));
    const double turn = 2.0 * std::numbers::pi * uniform(random);
    const double along = ball_radius + (height - 2.0 * ball_radius) * uniform(random);
    const Vec3 e1 = any_perpendicular(axis);
    const Vec3 e2 = axis.cross(e1);
    return base + along * axis + out * (std::cos(turn) * e1 + std::sin(turn) * e2);
}

} // namespace talus
