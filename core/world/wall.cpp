// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/wall.hpp"

#include "core/base/region.hpp"
#include "core/world/triangle_tree.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

/// A triangle with less than this area over its longest edge squared is a line but for rounding: nothing on it is well
/// defined.
constexpr double sliver = 1e-10;

/// A point that lies outside of a triangle by less than this share of its height is over it.
constexpr double same_place = 1e-6;

/// The result for a thin wall: the normal points from the wall to x, whichever side that is.
/// @param normal_if_on_wall called where x is on it
template <class Normal> WallPoint thin_wall_point(const Vec3& nearest, const Vec3& x, const Normal& normal_if_on_wall)
{
    const Vec3 away = x - nearest;
    const double distance = away.norm();
    if (distance > 0.0) return {nearest, away / distance, distance};
    return {nearest, normal_if_on_wall(), 0.0};
}

/// x in coordinates along and at right angles to an axis; `out` is a unit vector even on the axis.
struct AxisFrame {
    double along, radius;
    Vec3 out;

    AxisFrame(const Vec3& x, const Vec3& base, const Vec3& axis) : along((x - base).dot(axis))
    {
        const Vec3 across = x - base - along * axis;
        radius = across.norm();
        out = radius > 0.0 ? Vec3(across / radius) : any_perpendicular(axis);
    }
};

WallPoint nearest(const Plane& plane, std::size_t, const Vec3& x)
{
    const double distance = (x - plane.point).dot(plane.normal);
    return {x - distance * plane.normal, plane.normal, distance};
}

WallPoint nearest(const Cylinder& tube, std::size_t, const Vec3& x)
{
    const AxisFrame frame(x, tube.base, tube.axis);
    const double along = std::clamp(frame.along, 0.0, tube.height);
    return thin_wall_point(
        tube.base + along * tube.axis + tube.radius * frame.out, x, [&] { return Vec3(-frame.out); });
}

WallPoint nearest(const Cone& cone, std::size_t, const Vec3& x)
{
    // In the half-plane of x the funnel is a straight line from (0, base_radius) to (height, top_radius).
    const AxisFrame frame(x, cone.base, cone.axis);
    const double slope = cone.top_radius - cone.base_radius;
    const double length_squared = cone.height * cone.height + slope * slope;
    const double t =
        std::clamp((frame.along * cone.height + (frame.radius - cone.base_radius) * slope) / length_squared, 0.0, 1.0);
    const Vec3 nearest_point = cone.base + t * cone.height * cone.axis + (cone.base_radius + t * slope) * frame.out;
    return thin_wall_point(nearest_point, x,
        [&] { return Vec3((slope * cone.axis - cone.height * frame.out) / std::sqrt(length_squared)); });
}

WallPoint nearest(const Disk& disk, std::size_t, const Vec3& x)
{
    const AxisFrame frame(x, disk.center, disk.normal);
    const double out = std::clamp(frame.radius, disk.hole_radius, disk.radius);
    return thin_wall_point(disk.center + out * frame.out, x, [&] { return disk.normal; });
}

WallPoint nearest(const Panels& panels, std::size_t patch, const Vec3& x)
{
    const auto& panel = panels.rectangles[patch];
    const Vec3 from_corner = x - panel.corner;
    const double s = std::clamp(from_corner.dot(panel.edge_a) / panel.edge_a.squaredNorm(), 0.0, 1.0);
    const double t = std::clamp(from_corner.dot(panel.edge_b) / panel.edge_b.squaredNorm(), 0.0, 1.0);
    return thin_wall_point(panel.corner + s * panel.edge_a + t * panel.edge_b, x,
        [&] { return panel.edge_a.cross(panel.edge_b).normalized(); });
}

/// The point of triangle abc nearest to x, by the region of the triangle's plane that x lies over (Ericson 2005,
/// Real-Time Collision Detection, section 5.1.5).
Vec3 nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x)
{
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(x - a), d2 = ac.dot(x - a);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
    const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    return a + (vb * ab + vc * ac) / (va + vb + vc);
}

WallPoint nearest(const Mesh& mesh, std::size_t patch, const Vec3& x)
{
    const auto& t = mesh.triangles[patch];
    const auto vertex = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3& normal = mesh.normals[patch];
    const Vec3 nearest = nearest_on_triangle(vertex(0), vertex(1), vertex(2), x);
    // Over an edge that two triangles share, rounding decides which is nearer; the other's point must not tilt the
    // normal where they are flat: a sphere would roll off.
    const double height = (x - vertex(0)).dot(normal);
    const Vec3 foot = x - height * normal;
    const bool over_it = (foot - nearest).squaredNorm() <= same_place * same_place * height * height;
    return thin_wall_point(over_it ? foot : nearest, x, [&] { return normal; });
}

WallPoint nearest(const Grains& grains, std::size_t patch, const Vec3& x)
{
    const Vec3& center = grains.centers[patch];
    const Vec3 away = x - center;
    const double distance = away.norm();
    const Vec3 normal = distance > 0.0 ? Vec3(away / distance) : Vec3::UnitZ();
    return {center + grains.radius * normal, normal, distance - grains.radius};
}

/// Appends the grains that may meet the box.
void grains_near(const Grains& grains, const Box& box, std::vector<std::int32_t>& patches)
{
    const Box centers = box.grown(grains.radius);
    const auto begin = std::lower_bound(grains.centers.begin(), grains.centers.end(), centers.min.x(),
        [](const Vec3& center, double x) { return center.x() < x; });
    for (auto grain = begin; grain != grains.centers.end() && grain->x() <= centers.max.x(); ++grain)
        if (centers.contains(*grain)) patches.push_back(static_cast<std::int32_t>(grain - grains.centers.begin()));
}

Box bounds_of(const Plane&)
{
    return {};
}

/// Box around the circles of radius r0 and r1 at the two ends of an axis.
Box bounds_of_ends(const Vec3& base, const Vec3& axis, double height, double r0, double r1)
{
    const Vec3 half = disk_half_extent(axis);
    const Vec3 top = base + height * axis;
    return Box{base - r0 * half, base + r0 * half}.extend(Box{top - r1 * half, top + r1 * half});
}

Box bounds_of(const Cylinder& c)
{
    return bounds_of_ends(c.base, c.axis, c.height, c.radius, c.radius);
}
Box bounds_of(const Cone& c)
{
    return bounds_of_ends(c.base, c.axis, c.height, c.base_radius, c.top_radius);
}
Box bounds_of(const Disk& d)
{
    return bounds_of_ends(d.center, d.normal, 0.0, d.radius, d.radius);
}

Box bounds_of(const Panels& panels)
{
    Box box;
    for (const auto& p : panels.rectangles) box.extend(p.corner).extend(Vec3(p.corner + p.edge_a + p.edge_b));
    return box;
}

Box bounds_of(const Grains& grains)
{
    Box box;
    for (const Vec3& center : grains.centers) box.extend(center);
    return box.grown(grains.radius);
}

Box bounds_of(const Mesh& mesh)
{
    Box box;
    for (const auto& t : mesh.triangles)
        for (const auto k : t) box.extend(mesh.vertices[static_cast<std::size_t>(k)]);
    return box;
}

} // namespace

std::size_t patch_count(const Shape& shape)
{
    if (const auto* panels = std::get_if<Panels>(&shape)) return panels->rectangles.size();
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->triangles.size();
    if (const auto* grains = std::get_if<Grains>(&shape)) return grains->centers.size();
    return 1;
}

WallPoint nearest_point(const Shape& shape, std::size_t patch, const Vec3& x)
{
    return std::visit([&](const auto& s) { return nearest(s, patch, x); }, shape);
}

void patches_near(const Shape& shape, const Box& box, std::vector<std::int32_t>& patches)
{
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->tree->triangles_in(box, patches);
    if (const auto* grains = std::get_if<Grains>(&shape)) return grains_near(*grains, box, patches);
    const double half_diagonal = 0.5 * box.extent().norm();
    for (std::size_t k = 0; k < patch_count(shape); ++k)
        if (nearest_point(shape, k, box.center()).distance <= half_diagonal)
            patches.push_back(static_cast<std::int32_t>(k));
}

Box bounds(const Shape& shape)
{
    return std::visit([](const auto& s) { return bounds_of(s); }, shape);
}

Panels box_panels(const Box& box, const std::vector<std::string>& open)
{
    Panels panels;
    for (int d = 0; d < 3; ++d) {
        const Vec3 a = box.extent()[(d + 1) % 3] * Vec3::Unit((d + 1) % 3);
        const Vec3 b = box.extent()[(d + 2) % 3] * Vec3::Unit((d + 2) % 3);
        for (const char side : {'-', '+'}) {
            const std::string face = {static_cast<char>('x' + d), side};
            if (std::find(open.begin(), open.end(), face) != open.end()) continue;
            const Vec3 corner = side == '-' ? box.min : Vec3(box.min + box.extent()[d] * Vec3::Unit(d));
            panels.rectangles.push_back({corner, a, b});
        }
    }
    return panels;
}

Grains grain_bed(const Box& box, double diameter, double spacing)
{
    // As many equal cells along each axis as have room, each with a grain near its middle.
    std::array<std::size_t, 3> cells;
    Vec3 cell;
    for (int d = 0; d < 3; ++d) {
        cells[d] = std::max<std::size_t>(1, static_cast<std::size_t>(box.extent()[d] / spacing + 1e-9));
        cell[d] = box.extent()[d] / static_cast<double>(cells[d]);
    }
    Random random(1);
    Grains grains{{}, 0.5 * diameter};
    for (std::size_t i = 0; i < cells[0]; ++i)
        for (std::size_t j = 0; j < cells[1]; ++j)
            for (std::size_t k = 0; k < cells[2]; ++k) {
                const Vec3 place(
                    static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, static_cast<double>(k) + 0.5);
                Vec3 jitter;
                for (int d = 0; d < 3; ++d) jitter[d] = (uniform(random) - 0.5) * 2.0 / 3.0 * spacing;
                grains.centers.push_back(box.min + place.cwiseProduct(cell) + jitter);
            }
    std::sort(grains.centers.begin(), grains.centers.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    return grains;
}

bool has_area(const std::vector<Vec3>& vertices, const std::array<std::int32_t, 3>& triangle)
{
    const auto vertex = [&](std::size_t k) -> const Vec3& { return vertices[static_cast<std::size_t>(triangle[k])]; };
    const Vec3 ab = vertex(1) - vertex(0), ac = vertex(2) - vertex(0);
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    return ab.cross(ac).norm() > sliver * longest;
}

Mesh make_mesh(std::vector<Vec3> vertices, std::vector<std::array<std::int32_t, 3>> triangles)
{
    std::erase_if(triangles, [&](const auto& triangle) { return !has_area(vertices, triangle); });
    std::vector<Vec3> normals;
    for (const auto& [a, b, c] : triangles)
        normals.push_back((vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).normalized());
    auto tree = std::make_shared<const TriangleTree>(vertices, triangles);
    return {std::move(vertices), std::move(triangles), std::move(normals), std::move(tree)};
}

} // namespace talus
