// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <memory>
#include <optional>
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

/// A surface without a hole, for regions that no formula describes.
class ClosedSurface
{
public:
    virtual ~ClosedSurface() = default;
    /// How far x lies inside [m]; outside: minus its distance from the surface.
    virtual double depth(const Vec3& x) const = 0;
    virtual Box bounds() const = 0;
    virtual double volume() const = 0; ///< [m³]
};

/// A part of space. Fills, pours, outlets, sensors and frames have one.
struct Region {
    enum class Shape { box, cylinder, cone, sphere, inside };
    Shape shape = Shape::box;
    Box box;                   ///< box only
    Vec3 base = Vec3::Zero();  ///< cylinder, cone: centre of the first end; sphere: its centre [m]
    Vec3 axis = Vec3::UnitZ(); ///< cylinder, cone: unit vector from the first end to the second
    double radius = 0.0;       ///< cylinder, sphere; cone: of the first end [m]
    double top_radius = 0.0;   ///< cone: of the second end [m]
    double height = 0.0;       ///< cylinder, cone: distance of the ends
    std::shared_ptr<const ClosedSurface> surface = {}; ///< inside: what it is the inside of

    /// Whether a ball of this radius round x lies inside; radius 0 asks for the point alone.
    bool contains(const Vec3& x, double ball_radius = 0.0) const;

    /// How far x lies inside [m]; outside: minus its distance.
    double depth(const Vec3& x) const;

    double volume() const; ///< [m³]

    /// The smallest axis-aligned box around the region.
    Box bounds() const;

    /// A uniformly distributed centre of a ball of this radius that lies inside; nothing if this draw gave none, as
    /// happens where the shape is neither box nor cylinder.
    /// @pre the ball fits: `fits(ball_radius)`.
    std::optional<Vec3> random_point(Random& random, double ball_radius) const;

    /// Whether there is room for such a ball; of the inside of a surface, at one of 32³ places.
    bool fits(double ball_radius) const;
};

} // namespace talus
