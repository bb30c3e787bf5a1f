// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/closed_mesh.hpp"

#include "core/world/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace talus
{

std::size_t open_edges(const Mesh& mesh)
{
    std::map<std::pair<std::int32_t, std::int32_t>, int> triangles_at;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
            ++triangles_at[{a, b}];
        }
    return static_cast<std::size_t>(
        std::ranges::count_if(triangles_at, [](const auto& edge) { return edge.second == 1; }));
}

double ClosedMesh::depth(const Vec3& x) const
{
    const double distance = mesh_.tree->distance(x);
    return mesh_.tree->is_inside(x) ? distance : -distance;
}

Box ClosedMesh::bounds() const
{
    return talus::bounds(Shape(mesh_));
}

double ClosedMesh::volume() const
{
    // Of the pyramids over all triangles, with their tops in one corner (the divergence theorem).
    double six_volumes = 0.0;
    const Vec3 top = mesh_.vertices.front();
    for (const auto& t : mesh_.triangles) {
        const Vec3 a = mesh_.vertices[t[0]] - top, b = mesh_.vertices[t[1]] - top, c = mesh_.vertices[t[2]] - top;
        six_volumes += a.dot(b.cross(c));
    }
    return std::abs(six_volumes) / 6.0;
}

std::optional<Region> inside_of(const Shape& shape)
{
    Region inside;
    if (const auto* mesh = std::get_if<Mesh>(&shape); mesh && open_edges(*mesh) == 0) {
        inside.shape = Region::Shape::inside;
        inside.surface = std::make_shared<ClosedMesh>(*mesh);
        return inside;
    }
    constexpr std::size_t all_faces = 6;
    if (const auto* panels = std::get_if<Panels>(&shape); panels && panels->rectangles.size() == all_faces) {
        inside.box = bounds(shape);
        return inside;
    }
    return std::nullopt;
}

} // namespace talus
