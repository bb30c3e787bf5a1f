// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/world/wall.hpp"

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

/// @param axis unit
inline Region cone(const Vec3& base, const Vec3& axis, double base_radius, double top_radius, double height)
{
    Region region = cylinder(base, axis, base_radius, height);
    region.shape = Region::Shape::cone;
    region.top_radius = top_radius;
    return region;
}

inline Region sphere(const Vec3& center, double radius)
{
    Region region;
    region.shape = Region::Shape::sphere;
    region.base = center;
    region.radius = radius;
    return region;
}

/// A box as twelve triangles, the corners of a box in the order of their bits.
inline Mesh box_mesh(const Box& box)
{
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back(
            k & 1 ? box.max.x() : box.min.x(), k & 2 ? box.max.y() : box.min.y(), k & 4 ? box.max.z() : box.min.z());
    return make_mesh(corners, {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                  {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}});
}

/// An L, two cubes of edge 1 and one on top of the first: no convex body.
inline Mesh l_mesh()
{
    const std::vector<std::array<double, 2>> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    std::vector<Vec3> vertices;
    for (const double y : {0.0, 1.0})
        for (const auto& [x, z] : outline) vertices.emplace_back(x, y, z);
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (std::int32_t k = 0; k < 6; ++k) {
        const std::int32_t next = (k + 1) % 6;
        triangles.push_back({k, next, k + 6});
        triangles.push_back({next, next + 6, k + 6});
    }
    for (const std::int32_t side : {0, 6})
        for (const auto& [a, b, c] :
            std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}})
            triangles.push_back({a + side, b + side, c + side});
    return make_mesh(vertices, triangles);
}

} // namespace talus::test
