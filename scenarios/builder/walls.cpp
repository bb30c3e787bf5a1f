// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/walls.hpp"

#include "scenarios/builder/checks.hpp"
#include "scenarios/builder/materials.hpp"
#include "scenarios/builder/meshes.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr double most_grains = 1e7; ///< of a wall: a gigabyte, about, with what a search needs

Grains build_grains(const scene::WallTable& w, const Box& box, const std::string& key)
{
    const double spacing = w.spacing * w.diameter;
    double count = 1.0;
    for (int d = 0; d < 3; ++d) count *= std::max(1.0, box.extent()[d] / spacing);
    if (!(count <= most_grains))
        throw SceneError(key, "the wall would have more than 10000000 grains; make them larger, or its box smaller");
    return grain_bed(box, w.diameter, spacing);
}

Shape build_shape(const scene::WallTable& w, std::size_t index, double diameter)
{
    const auto key = [&](const char* name) { return key_path("wall", index, name); };
    if (w.shape == "plane") return Plane{w.point, unit_vector(w.normal, key("normal"))};
    if (w.shape == "box") return box_panels(require_box(w.min, w.max, key("max")), w.open);
    if (w.shape == "disk") {
        require_positive(w.radius, key("radius"), "the radius of a disk");
        if (w.hole_radius >= w.radius) throw SceneError(key("hole_radius"), "the hole must be smaller than the disk");
        return Disk{w.center, unit_vector(w.normal, key("normal")), w.radius, w.hole_radius};
    }
    if (w.shape == "grains") return build_grains(w, require_layer(w.min, w.max, key("max")), key("diameter"));
    if (w.shape == "mesh") return build_mesh(w, diameter, key("mesh"));
    require_positive(w.height, key("height"), "the height of a " + w.shape);
    const Vec3 axis = unit_vector(w.axis, key("axis"));
    if (w.shape == "cylinder") {
        require_positive(w.radius, key("radius"), "the radius of a cylinder");
        return Cylinder{w.base, axis, w.radius, w.height};
    }
    require_positive(std::max(w.base_radius, w.top_radius), key("base_radius"), "one of the radii of a cone");
    return Cone{w.base, axis, w.base_radius, w.top_radius, w.height};
}

/// @param rows of a table, each with its time
void require_rising(const auto& rows, const std::string& key, const std::string& table)
{
    const auto falls_back = [](const auto& row, const auto& next) { return !(next.time > row.time); };
    if (std::ranges::adjacent_find(rows, falls_back) != rows.end())
        throw SceneError(key + "." + table, "the times of '" + table + "' must rise from row to row");
}

MotionPart build_motion_part(const scene::MotionTable& m, const std::string& key)
{
    if (m.kind != "table" && !(m.to >= m.from)) throw SceneError(key + ".to", "'to' must not be before 'from'");
    const MotionSpan span{m.from, m.to};
    if (m.kind == "translate") return Translation{span, m.velocity};
    if (m.kind == "turn") return Turning{span, m.point, unit_vector(m.axis, key + ".axis"), m.rate};
    if (m.kind == "shake") return Shaking{span, m.amplitude, m.frequency};
    if (m.table.empty()) throw SceneError(key + ".table", "'table' needs at least one row [time, x, y, z]");
    require_rising(m.table, key, "table");
    return Course{m.table};
}

WallMotion build_motion(const scene::WallTable& table, std::size_t index)
{
    WallMotion motion;
    for (std::size_t k = 0; k < table.motion.size(); ++k)
        motion.push_back(build_motion_part(table.motion[k], key_path("wall", index, table_path("motion", k))));
    return motion;
}

/// A plane is as wide as the world and its own image, so it must not cross a periodic axis, nor turn so that it does.
void require_seamless(const Wall& wall, const Periodicity& periodicity, std::size_t index)
{
    const auto* plane = std::get_if<Plane>(&wall.shape);
    for (int d = 0; plane && d < 3; ++d) {
        if (!periodicity.along(d)) continue;
        if (std::abs(plane->normal[d]) > 1e-9)
            throw SceneError(key_path("wall", index, "normal"),
                "a plane across a periodic axis would cut every image; use another shape");
        for (std::size_t k = 0; k < wall.motion.size(); ++k) {
            const auto* turning = std::get_if<Turning>(&wall.motion[k]);
            if (turning && turning->axis.cross(plane->normal).norm() > 1e-9 &&
                turning->axis.cross(Vec3::Unit(d)).norm() > 1e-9)
                throw SceneError(key_path("wall", index, table_path("motion", k) + ".axis"),
                    "a plane that turns about this axis would come to cut every image; use another shape");
        }
    }
}

void refuse_keys_without_mass(const scene::WallTable& w, std::size_t index)
{
    const auto refuse = [&](bool given, const char* name) {
        if (given)
            throw SceneError(key_path("wall", index, name), std::string("'") + name + "' goes with a finite 'mass'");
    };
    refuse(!w.guide.isZero(), "guide");
    refuse(!w.load.empty(), "load");
    refuse(w.released_at > 0.0, "released_at");
}

void require_piston(const scene::WallTable& w, std::size_t index)
{
    const auto key = [&](const char* name) { return key_path("wall", index, name); };
    if (!w.motion.empty())
        throw SceneError(
            key("mass"), "a wall moves as prescribed or as forces have it: leave out 'mass' or the motion");
    if (w.appear_at > 0.0 || w.remove_at < infinity)
        throw SceneError(
            key("mass"), "a wall of finite mass is there for the whole run: leave out 'appear_at' and 'remove_at'");
    if (w.guide.isZero())
        throw SceneError(key("guide"), "a wall of finite mass needs a 'guide', the axis along which it moves");
}

Piston build_piston(const scene::WallTable& w, std::size_t index, const Shape& shape, const Periodicity& periodicity)
{
    require_piston(w, index);
    require_rising(w.load, table_path("wall", index), "load");
    const Box box = bounds(shape);
    const Vec3 guide = unit_vector(w.guide, key_path("wall", index, "guide"));
    for (int d = 0; d < 3; ++d)
        if (periodicity.along(d) && guide[d] != 0.0)
            throw SceneError(key_path("wall", index, "guide"), "a guide must not lead along a periodic axis");
    return {.wall = index,
        .mass = w.mass,
        .guide = guide,
        .center = box.center(),
        .inertia = block_inertia(w.mass, box.extent()),
        .load = w.load,
        .released_at = w.released_at};
}

} // namespace

std::vector<Wall> build_walls(
    const scene::Scene& scene, const Materials& materials, const Periodicity& periodicity, double diameter)
{
    std::vector<Wall> walls;
    for (std::size_t k = 0; k < scene.wall.size(); ++k) {
        const auto& w = scene.wall[k];
        const int material = material_index(materials, w.material, key_path("wall", k, "material"));
        auto shape = build_shape(w, k, diameter);
        walls.push_back({w.name, std::move(shape), material, w.appear_at, w.remove_at, build_motion(w, k)});
        require_seamless(walls.back(), periodicity, k);
    }
    return walls;
}

std::vector<Piston> build_pistons(const scene::Scene& scene, std::vector<Wall>& walls, const Periodicity& periodicity)
{
    std::vector<Piston> pistons;
    for (std::size_t k = 0; k < scene.wall.size(); ++k) {
        if (!std::isfinite(scene.wall[k].mass)) {
            refuse_keys_without_mass(scene.wall[k], k);
            continue;
        }
        walls[k].piston = static_cast<std::int32_t>(pistons.size());
        pistons.push_back(build_piston(scene.wall[k], k, walls[k].shape, periodicity));
    }
    return pistons;
}

} // namespace talus
