// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace talus
{

/// The path of a table in a list: "wall[2]".
std::string table_path(const std::string& list, std::size_t index);

/// The path of a key in a list of tables: "wall[2].material".
std::string key_path(const std::string& list, std::size_t index, const std::string& key);

/// The names of the elements of a list.
template <class Named> std::vector<std::string> names_of(const std::vector<Named>& list)
{
    std::vector<std::string> names;
    for (const Named& element : list) names.push_back(element.name);
    return names;
}

/// @param what has the name: "material"; @param known the names that the scene has; @throws SceneError always
[[noreturn]] void refuse_unknown(
    const std::string& what, const std::string& name, const std::vector<std::string>& known, const std::string& key);

/// The index of the element of this name.
/// @param what the elements are: "material"; @param key where the name stands; @throws SceneError where there is none
template <class Named>
std::size_t index_of(
    const std::vector<Named>& list, const std::string& what, const std::string& name, const std::string& key)
{
    const auto found = std::ranges::find(list, name, &Named::name);
    if (found == list.end()) refuse_unknown(what, name, names_of(list), key);
    return static_cast<std::size_t>(found - list.begin());
}

/// The direction as a unit vector. @throws SceneError where it is zero
Vec3 unit_vector(const Vec3& direction, const std::string& key);

/// @param what in the sentence: "the radius of a disk"; @throws SceneError unless the value is finite and above 0
void require_positive(double value, const std::string& key, const std::string& what);

/// The box between two corners, which may be flat. @throws SceneError where one lies beyond the other
Box require_layer(const Vec3& min, const Vec3& max, const std::string& key);

/// The box between two corners. @throws SceneError where it is empty
Box require_box(const Vec3& min, const Vec3& max, const std::string& key);

/// The region that a table describes. @param diameter of the spheres, on average [m]; @param key its path
/// @throws SceneError where it is empty, or a mesh has a hole
Region require_region(const scene::RegionTable& table, double diameter, const std::string& key);

} // namespace talus
