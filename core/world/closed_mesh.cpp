// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/closed_mesh.hpp"

#include "core/base/disjoint_sets.hpp"
#include "core/world/triangle_tree.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <numeric>

namespace talus
{
namespace
{

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using Side = CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel>;

Point point(const Vec3& x)
{
    return {x[0], x[1], x[2]};
}

Vec3 vector(const Point& x)
{
    return {x.x(), x.y(), x.z()};
}

/// Sets of corners that are one.
DisjointSets same_corners(const std::vector<Vec3>& corners, double weld)
{
    DisjointSets sets(corners.size());
    const Vec3 along = Vec3(0.31, 0.47, 0.83).normalized(); // no direction of drawings: few corners are level in it
    std::vector<std::size_t> order(corners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return along.dot(corners[i]); });
    for (auto a = order.begin(); a != order.end(); ++a)
        for (auto b = a + 1; b != order.end(); ++b) {
            const Vec3 apart = corners[*b] - corners[*a];
            if (along.dot(apart) > weld) break;
            if (apart.norm() <= weld) sets.join(*a, *b);
        }
    return sets;
}

SurfaceMesh surface_of(const Mesh& mesh, double weld)
{
    std::vector<Point> corners;
    std::ranges::transform(mesh.vertices, std::back_inserter(corners), point);
    DisjointSets sets = same_corners(mesh.vertices, weld);
    std::vector<std::vector<std::size_t>> triangles;
    for (const auto& t : mesh.triangles) {
        std::vector<std::size_t> triangle;
        for (const std::int32_t corner : t) triangle.push_back(sets.first_of_set(static_cast<std::size_t>(corner)));
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
            triangles.push_back(std::move(triangle));
    }
    processing::repair_polygon_soup(corners, triangles);
    processing::orient_polygon_soup(corners, triangles);
    SurfaceMesh surface;
    processing::polygon_soup_to_polygon_mesh(corners, triangles, surface);
    processing::stitch_borders(surface);
    if (CGAL::is_closed(surface)) processing::orient_to_bound_a_volume(surface);
    return surface;
}

} // namespace

struct ClosedMesh::Surface {
    std::shared_ptr<const TriangleTree> tree;
    Box bounds;
    SurfaceMesh welded;
    Side side;

    Surface(const Mesh& given, double weld)
        : tree(given.tree), bounds(talus::bounds(Shape(given))), welded(surface_of(given, weld)), side(welded)
    {
    }
};

ClosedMesh::ClosedMesh(const Mesh& mesh, double weld) : surface_(std::make_unique<Surface>(mesh, weld)) {}

ClosedMesh::~ClosedMesh() = default;

std::vector<Hole> ClosedMesh::holes() const
{
    const SurfaceMesh& surface = surface_->welded;
    std::vector<SurfaceMesh::Halfedge_index> borders; // one of each
    processing::extract_boundary_cycles(surface, std::back_inserter(borders));
    std::vector<Hole> holes;
    for (const auto border : borders) {
        Hole hole;
        for (const auto edge : CGAL::halfedges_around_face(border, surface)) {
            ++hole.edges;
            hole.place += vector(surface.point(surface.target(edge)));
            hole.length += processing::edge_length(edge, surface);
        }
        hole.place /= static_cast<double>(hole.edges);
        holes.push_back(hole);
    }
    return holes;
}

double ClosedMesh::depth(const Vec3& x) const
{
    const double distance = surface_->tree->distance(x);
    return surface_->side(point(x)) == CGAL::ON_UNBOUNDED_SIDE ? -distance : distance;
}

Box ClosedMesh::bounds() const
{
    return surface_->bounds;
}

double ClosedMesh::volume() const
{
    return CGAL::to_double(processing::volume(surface_->welded));
}

std::optional<Region> inside_of(const Shape& shape, double weld)
{
    Region inside;
    if (const auto* mesh = std::get_if<Mesh>(&shape)) {
        auto surface = std::make_shared<ClosedMesh>(*mesh, weld);
        if (!surface->holes().empty()) return std::nullopt;
        inside.shape = Region::Shape::inside;
        inside.surface = std::move(surface);
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
