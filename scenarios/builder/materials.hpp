// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/material.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// The materials of the scene and the law of each pair of them.
/// @throws SceneError also where two materials can touch and have no law
Materials build_materials(const scene::Scene& scene);

/// The index of a material by its name. @param key where the name stands; @throws SceneError where there is none
int material_index(const Materials& materials, const std::string& name, const std::string& key);

} // namespace talus
