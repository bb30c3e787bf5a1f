// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/checks.hpp"

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

Region require_region(const scene::RegionTable& table, const std::string& key)
{
    Region region;
    if (table.shape == "box") {
        region.box = require_box(table.min, table.max, key + ".max");
        return region;
    }
    require_positive(table.radius, key + ".radius", "the radius of a cylinder");
    require_positive(table.height, key + ".height", "the height of a cylinder");
    region.shape = Region::Shape::cylinder;
    region.base = table.base;
    region.axis = unit_vector(table.axis, key + ".axis");
    region.radius = table.radius;
    region.height = table.height;
    return region;
}

} // namespace talus
