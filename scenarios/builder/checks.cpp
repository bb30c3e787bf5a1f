// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/checks.hpp"

#include "core/world/closed_mesh.hpp"
#include "scenarios/builder/meshes.hpp"

#include <cmath>

namespace talus
{

std::string table_path(const std::string& list, std::size_t index)
{
    return list + "[" + std::to_string(index) + "]";
}

std::string key_path(const std::string& list, std::size_t index, const std::string& key)
{
    return table_path(list, index) + "." + key;
}

void refuse_unknown(
    const std::string& what, const std::string& name, const std::vector<std::string>& known, const std::string& key)
{
    std::string list;
    for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
    throw SceneError(key, "unknown " + what + " '" + name + "'; the scene has " + (list.empty() ? "none" : list));
}

Vec3 unit_vector(const Vec3& direction, const std::string& key)
{
    if (direction.isZero()) throw SceneError(key, "a direction must not be zero");
    return direction.normalized();
}

void require_positive(double value, const std::string& key, const std::string& what)
{
    if (!(value > 0.0) || !std::isfinite(value)) throw SceneError(key, what + " must be given, and greater than 0");
}

Box require_layer(const Vec3& min, const Vec3& max, const std::string& key)
{
    if (!((min.array() <= max.array()).all()))
        throw SceneError(key, "no coordinate of 'min' may be above that of 'max'");
    return {min, max};
}

Box require_box(const Vec3& min, const Vec3& max, const std::string& key)
{
    if (!((min.array() < max.array()).all()))
        throw SceneError(key, "the box is empty: every coordinate of 'min' must be below that of 'max'");
    return {min, max};
}

Region require_region(const scene::RegionTable& table, double diameter, const std::string& key)
{
    Region region;
    if (table.shape == "box") {
        region.box = require_box(table.min, table.max, key + ".max");
        return region;
    }
    if (table.shape == "mesh") {
        const Mesh mesh = make_mesh(table.vertices, table.triangles);
        if (mesh.triangles.empty()) throw SceneError(key + ".mesh", "a region needs an STL file with triangles");
        if (auto inside = inside_of(mesh, same_corner * diameter)) return *inside;
        throw SceneError(
            key + ".mesh", "nothing is inside of '" + table.mesh + "': it has " + holes_in_words(mesh, diameter));
    }
    if (table.shape == "sphere") {
        require_positive(table.radius, key + ".radius", "the radius of a sphere");
        region.shape = Region::Shape::sphere;
        region.base = table.center;
        region.radius = table.radius;
        return region;
    }
    const bool cone = table.shape == "cone";
    region.shape = cone ? Region::Shape::cone : Region::Shape::cylinder;
    if (cone)
        require_positive(table.base_radius + table.top_radius, key + ".base_radius", "a radius of a cone");
    else
        require_positive(table.radius, key + ".radius", "the radius of a cylinder");
    require_positive(table.height, key + ".height", "the height of a " + table.shape);
    region.base = table.base;
    region.axis = unit_vector(table.axis, key + ".axis");
    region.radius = cone ? table.base_radius : table.radius;
    region.top_radius = table.top_radius;
    region.height = table.height;
    return region;
}

} // namespace talus
