// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"
#include "core/world/wall_motion.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace talus
{

class TriangleTree;

/// A half-space that spheres must stay out of: everything behind the plane is wall. The only one-sided shape.
struct Plane {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ(); ///< unit, into the free side
};

/// A thin open tube, both sides of which are wall.
struct Cylinder {
    Vec3 base = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ(); ///< unit
    double radius = 0.0;
    double height = 0.0;
};

/// A thin conical funnel (frustum), open at both ends.
struct Cone {
    Vec3 base = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ(); ///< unit
    double base_radius = 0.0;  ///< at `base`
    double top_radius = 0.0;   ///< at `base + height axis`
    double height = 0.0;
};

/// A thin round plate, with a round hole in the middle if hole_radius > 0.
struct Disk {
    Vec3 center = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ(); ///< unit
    double radius = 0.0;
    double hole_radius = 0.0;
};

/// Flat thin panels: the faces of a box that are not open.
struct Panels {
    struct Rectangle {
        Vec3 corner, edge_a, edge_b; ///< corner + s edge_a + t edge_b, s and t in [0, 1], edges at right angles
    };
    std::vector<Rectangle> rectangles;
};

/// A thin surface of triangles in the wall's own frame, with CGAL's tree over them.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<Vec3> normals;                ///< by triangle, unit; made by `make_mesh`, as …
    std::shared_ptr<const TriangleTree> tree; ///< … this is
};

/// Solid spheres fixed to each other: a rough bed.
struct Grains {
    std::vector<Vec3> centers; ///< in ascending order of x, so that those near a place are found by halving
    double radius = 0.0;       ///< [m]
};

using Shape = std::variant<Plane, Cylinder, Cone, Disk, Panels, Mesh, Grains>;

/// A rigid wall: a shape that stands from appear_at until remove_at, and moves as prescribed, whatever pushes against
/// it, unless it is a piston's.
struct Wall {
    std::string name;
    Shape shape;
    int material = 0;
    double appear_at = 0.0;      ///< [s]
    double remove_at = infinity; ///< [s]
    WallMotion motion = {};      ///< from where the shape says; empty: it stands still
    std::int32_t piston = -1;    ///< index into Model::pistons and State::pistons; −1: it moves as prescribed

    bool is_piston() const { return piston >= 0; }
    bool moves() const { return is_piston() || !motion.empty(); }
    bool stands_at(double time) const { return time >= appear_at && time < remove_at; }
};

/// Where a wall is nearest to a point, seen through one of its patches.
struct WallPoint {
    Vec3 point;      ///< on the wall [m]
    Vec3 normal;     ///< unit, from the wall to the point asked for
    double distance; ///< along the normal [m]; < 0 only behind a Plane and inside a grain
    std::int32_t patch = 0;
};

/// A shape is made of patches, each with one nearest point: a plane, tube, funnel or plate is one patch, a box has one
/// for each face, a mesh one for each triangle, grains one for each.
std::size_t patch_count(const Shape& shape);

/// The point of a patch nearest to x.
WallPoint nearest_point(const Shape& shape, std::size_t patch, const Vec3& x);

/// Appends the patches that may meet the box (all that do, perhaps a few more) in ascending order.
void patches_near(const Shape& shape, const Box& box, std::vector<std::int32_t>& patches);

/// The smallest box around the shape; a plane has none and gives an empty one.
Box bounds(const Shape& shape);

/// Panels of the faces of `box`; `open` names faces left out ("x-", "x+", …, "z+").
Panels box_panels(const Box& box, const std::vector<std::string>& open);

/// Grains on a square lattice jittered in all directions by up to a third of its spacing, layer by layer from the lower
/// corner of `box`, which holds their centres; along an axis on which it is flat there is one layer. Always the same.
Grains grain_bed(const Box& box, double diameter, double spacing);

/// Whether a triangle is more than a line, but for rounding.
bool has_area(const std::vector<Vec3>& vertices, const std::array<std::int32_t, 3>& triangle);

/// A mesh with its search tree. Triangles without area are dropped.
Mesh make_mesh(std::vector<Vec3> vertices, std::vector<std::array<std::int32_t, 3>> triangles);

} // namespace talus
