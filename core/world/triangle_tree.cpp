// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/triangle_tree.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& x)
{
    return {x[0], x[1], x[2]};
}

} // namespace

struct TriangleTree::Tree {
    Triangles triangles;
    CgalTree cgal;
};

TriangleTree::TriangleTree(const std::vector<Vec3>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles)
{
    auto tree = std::make_unique<Tree>();
    const auto vertex = [&](std::int32_t i) { return point(vertices[static_cast<std::size_t>(i)]); };
    for (const auto& t : triangles) tree->triangles.emplace_back(vertex(t[0]), vertex(t[1]), vertex(t[2]));
    tree->cgal.insert(tree->triangles.cbegin(), tree->triangles.cend());
    tree->cgal.build();
    tree_ = std::move(tree);
}

TriangleTree::~TriangleTree() = default;

void TriangleTree::triangles_in(const Box& box, std::vector<std::int32_t>& found) const
{
    // A box and not a sphere: CGAL takes Sphere_3 for a surface and misses triangles wholly inside it.
    const CGAL::Bbox_3 query(box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]);
    std::vector<Triangles::const_iterator> hits;
    tree_->cgal.all_intersected_primitives(query, std::back_inserter(hits));
    const auto first = found.size();
    for (const auto& hit : hits) found.push_back(static_cast<std::int32_t>(hit - tree_->triangles.cbegin()));
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end());
}

double TriangleTree::distance(const Vec3& x) const
{
    return std::sqrt(tree_->cgal.squared_distance(point(x)));
}

} // namespace talus
