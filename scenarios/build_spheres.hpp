// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/pour.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// @param key the path of the diameter, for errors; @throws SceneError where it is not positive
SizeDistribution build_sizes(const scene::DiameterTable& table, const std::string& key);

/// Puts the spheres of all fills into the state, in the order of the scene.
/// @throws SceneError where a region cannot hold them
void fill_spheres(Simulation& simulation, const scene::Scene& scene, Random& random);

/// The pours in the order of the scene, each with a random generator of its own. @throws SceneError
std::vector<Pour> build_pours(const scene::Scene& scene, const Model& model, Random& random);

} // namespace talus
