// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/material.hpp"
#include "core/periodicity.hpp"
#include "core/wall.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// The walls in the order of the scene. @throws SceneError where a shape is empty or a material unknown
std::vector<Wall> build_walls(const scene::Scene& scene, const Materials& materials, const Periodicity& periodicity);

} // namespace talus
