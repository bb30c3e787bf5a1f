// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// The smallest, largest and mean diameter of all spheres that the scene makes, into the model.
/// @pre the model has its materials
/// @throws SceneError where it makes none
void find_diameters(Model& model, const scene::Scene& scene);

/// The box that no sphere may leave: that of walls, fills, pours and outlets, grown by five diameters and open upwards,
/// where the scene does not say. @throws SceneError where it is empty
Box build_world(const scene::Scene& scene, const Model& model);

} // namespace talus
