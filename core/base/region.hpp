// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <random>

namespace talus
{

/// The generator of every random number of a run; its state belongs to whoever draws.
using Random = std::mt19937_64;

/// A uniform number in [0, 1), the same on every platform (the standard distributions are not).
inline double uniform(Random& random)
{
    return static_cast<double>(random() >> 11) * 0x1.0p-53;
}

/// Half of the size, along each coordinate, of a disk of radius 1 at right angles to a unit axis.
inline Vec3 disk_half_extent(const Vec3& axis)
{
    return (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

/// A part of space: a box, or an upright or tilted cylinder. Fills, pours and outlets have one.
struct Region {
    enum class Shape { box, cylinder };
    Shape shape = Shape::box;
    Box box;                   ///< box only
    Vec3 base = Vec3::Zero();  ///< cylinder: centre of its first end [m]
    Vec3 axis = Vec3::UnitZ(); ///< cylinder: unit vector from the first end to the second
    double radius = 0.0;       ///< cylinder [m]
    double height = 0.0;       ///< cylinder: distance of its ends [m]

    /// Whether a ball of this radius round x lies inside; radius 0 asks for the point alone.
    bool contains(const Vec3& x, double ball_radius = 0.0) const;

    /// The smallest axis-aligned box around the region.
    Box bounds() const;

    /// A uniformly distributed centre of a ball of this radius that lies inside.
    /// @pre the ball fits: `fits(ball_radius)`.
    Vec3 random_point(Random& random, double ball_radius) const;

    bool fits(double ball_radius) const;
};

} // namespace talus
