// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// The materials of the scene and the law of each pair of them.
/// @throws SceneError also where two materials can touch and have no law
Materials build_materials(const scene::Scene& scene);

/// What draws the materials together, as far as [[contact]] says so.
/// @param model has its materials, gravity and diameters; @throws SceneError
void add_attractions(Model& model, const scene::Scene& scene);

/// The index of a material by its name. @param key where the name stands; @throws SceneError where there is none
int material_index(const Materials& materials, const std::string& name, const std::string& key);

} // namespace talus
