// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <limits>

namespace talus
{

using Vec3 = Eigen::Vector3d;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// An axis-aligned box [m]. The default one is empty: it contains nothing and grows by `extend`.
struct Box {
    Vec3 min = Vec3::Constant(infinity);
    Vec3 max = Vec3::Constant(-infinity);

    bool empty() const { return !(min.array() <= max.array()).all(); }
    Vec3 center() const { return 0.5 * (min + max); }
    Vec3 extent() const { return max - min; }
    bool contains(const Vec3& x) const { return (x.array() >= min.array()).all() && (x.array() <= max.array()).all(); }
    bool contains(const Box& b) const
    {
        return (b.min.array() >= min.array()).all() && (b.max.array() <= max.array()).all();
    }
    bool meets(const Box& b) const
    {
        return (b.min.array() <= max.array()).all() && (min.array() <= b.max.array()).all();
    }

    Box& extend(const Vec3& x)
    {
        min = min.cwiseMin(x);
        max = max.cwiseMax(x);
        return *this;
    }
    Box& extend(const Box& b)
    {
        min = min.cwiseMin(b.min);
        max = max.cwiseMax(b.max);
        return *this;
    }
    Box shifted(const Vec3& shift) const { return {min + shift, max + shift}; }
    Box grown(double margin) const { return {min.array() - margin, max.array() + margin}; }
    std::array<Vec3, 8> corners() const
    {
        std::array<Vec3, 8> points;
        for (std::size_t k = 0; k < 8; ++k)
            for (int d = 0; d < 3; ++d) points[k][d] = (k >> d) & 1 ? max[d] : min[d];
        return points;
    }
};

/// Any unit vector at a right angle to the unit vector n; the same one every time.
inline Vec3 any_perpendicular(const Vec3& n)
{
    return n.unitOrthogonal();
}

} // namespace talus
