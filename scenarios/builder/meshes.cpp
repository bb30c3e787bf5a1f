// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/meshes.hpp"

#include "core/world/closed_mesh.hpp"
#include "scenarios/builder/world.hpp"
#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cstdio>

namespace talus
{
namespace
{

/// As the file counts them, from 1.
std::string number_of(std::size_t triangle)
{
    return "triangle " + std::to_string(triangle + 1);
}

void require_within_reach(const scene::WallTable& table, double diameter, const std::string& key)
{
    for (std::size_t t = 0; t < table.triangles.size(); ++t)
        for (const auto vertex : table.triangles[t])
            if (!is_within_reach(table.vertices[static_cast<std::size_t>(vertex)], diameter))
                throw SceneError(key, number_of(t) + " of '" + table.mesh + "' reaches more than 1e9 diameters from " +
                                          "the origin; mend the file, or give the wall a 'scale'");
}

} // namespace

Mesh build_mesh(const scene::WallTable& table, double diameter, const std::string& key)
{
    if (table.triangles.empty()) throw SceneError(key, "a wall of shape \"mesh\" needs an STL file with triangles");
    require_within_reach(table, diameter, key);
    Mesh mesh = make_mesh(table.vertices, table.triangles);
    if (mesh.triangles.empty()) throw SceneError(key, "no triangle of '" + table.mesh + "' has an area");
    return mesh;
}

std::string holes_in_words(const Mesh& mesh, double diameter)
{
    const std::vector<Hole> holes = ClosedMesh(mesh, same_corner * diameter).holes();
    if (holes.empty()) return "";
    const Hole& longest = *std::ranges::max_element(holes, {}, &Hole::length);
    char text[160];
    std::snprintf(text, sizeof text, "%zu edges of one triangle only, %.3g m in all, round (%.4g, %.4g, %.4g)",
        longest.edges, longest.length, longest.place.x(), longest.place.y(), longest.place.z());
    if (holes.size() == 1) return std::string("a hole of ") + text;
    return std::to_string(holes.size()) + " holes, the longest of " + text;
}

std::string left_out_of_mesh(const scene::WallTable& table)
{
    const auto is_flat = [&](const auto& triangle) { return !has_area(table.vertices, triangle); };
    const auto first = std::ranges::find_if(table.triangles, is_flat);
    if (first == table.triangles.end()) return "";
    char text[80];
    std::snprintf(text, sizeof text, "%td of %zu triangles have no area and are left out, first ",
        std::count_if(first, table.triangles.end(), is_flat), table.triangles.size());
    return "wall '" + table.name + "': " + text + number_of(static_cast<std::size_t>(first - table.triangles.begin())) +
           " of '" + table.mesh + "'";
}

} // namespace talus
