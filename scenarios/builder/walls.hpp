// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/periodicity.hpp"
#include "core/world/material.hpp"
#include "core/world/piston.hpp"
#include "core/world/wall.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// The walls in the order of the scene. @param diameter of the spheres [m]
/// @throws SceneError where a shape is empty or a material unknown
std::vector<Wall> build_walls(
    const scene::Scene& scene, const Materials& materials, const Periodicity& periodicity, double diameter);

/// The walls of finite mass, in their order; each of these gets the index of its piston. Their mass is spread evenly
/// over the box round them.
/// @param walls those of the scene
/// @throws SceneError where a mass has no guide, or something that it cannot go with
std::vector<Piston> build_pistons(const scene::Scene& scene, std::vector<Wall>& walls, const Periodicity& periodicity);

} // namespace talus
