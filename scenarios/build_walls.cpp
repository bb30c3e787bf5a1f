// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build_walls.hpp"

#include "scenarios/build_materials.hpp"
#include "scenarios/scene_checks.hpp"

#include <algorithm>

namespace talus
{
namespace
{

Shape build_shape(const scene::WallTable& w, std::size_t index)
{
    const auto key = [&](const char* name) { return key_path("wall", index, name); };
    if (w.shape == "plane") return Plane{w.point, unit_vector(w.normal, key("normal"))};
    if (w.shape == "box") return box_panels(require_box(w.min, w.max, key("max")), w.open);
    if (w.shape == "disk") {
        require_positive(w.radius, key("radius"), "the radius of a disk");
        if (w.hole_radius >= w.radius) throw SceneError(key("hole_radius"), "the hole must be smaller than the disk");
        return Disk{w.center, unit_vector(w.normal, key("normal")), w.radius, w.hole_radius};
    }
    if (w.shape == "mesh") {
        if (w.triangles.empty())
            throw SceneError(key("mesh"), "a wall of shape \"mesh\" needs an STL file with triangles");
        return make_mesh(w.vertices, w.triangles);
    }
    require_positive(w.height, key("height"), "the height of a " + w.shape);
    const Vec3 axis = unit_vector(w.axis, key("axis"));
    if (w.shape == "cylinder") {
        require_positive(w.radius, key("radius"), "the radius of a cylinder");
        return Cylinder{w.base, axis, w.radius, w.height};
    }
    require_positive(std::max(w.base_radius, w.top_radius), key("base_radius"), "one of the radii of a cone");
    return Cone{w.base, axis, w.base_radius, w.top_radius, w.height};
}

} // namespace

std::vector<Wall> build_walls(const scene::Scene& scene, const Materials& materials)
{
    std::vector<Wall> walls;
    for (std::size_t k = 0; k < scene.wall.size(); ++k) {
        const auto& w = scene.wall[k];
        const int material = material_index(materials, w.material, key_path("wall", k, "material"));
        walls.push_back({w.name, build_shape(w, k), material, w.appear_at, w.remove_at});
    }
    return walls;
}

} // namespace talus
