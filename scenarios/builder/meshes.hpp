// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/wall.hpp"
#include "scenarios/scene.hpp"

#include <string>

namespace talus
{

/// The mesh of a wall, from its triangles that have an area.
/// @param diameter of the spheres [m]; @param key of the wall's STL file
/// @throws SceneError where none has, or a vertex lies too far from the origin
Mesh build_mesh(const scene::WallTable& table, double diameter, const std::string& key);

/// Where a mesh is open; empty where it is closed. @param diameter of the spheres, on average [m]
std::string holes_in_words(const Mesh& mesh, double diameter);

/// What a wall's STL file has that its mesh has not; empty where that is nothing.
std::string left_out_of_mesh(const scene::WallTable& table);

} // namespace talus
