// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "scenarios/scene_error.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// Builds the simulation that a scene describes. The meshes of its walls must have been read (WallTable::triangles).
/// @throws SceneError
Simulation build_scene(const scene::Scene& scene);

} // namespace talus
