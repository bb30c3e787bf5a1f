// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace talus
{

/// CGAL's AABB tree over the triangles of a rigid mesh, in the mesh's own frame.
class TriangleTree
{
public:
    TriangleTree(const std::vector<Vec3>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles);
    ~TriangleTree();
    TriangleTree(const TriangleTree&) = delete;
    TriangleTree& operator=(const TriangleTree&) = delete;

    /// Appends the triangles that meet the box, in ascending order. Safe to call from several threads.
    void triangles_in(const Box& box, std::vector<std::int32_t>& found) const;

    /// Of x from the nearest triangle [m].
    double distance(const Vec3& x) const;

private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace talus
