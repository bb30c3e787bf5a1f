// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/pour.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// Puts the spheres of all fills into the state, in the order of the scene.
/// @throws SceneError where a region cannot hold them
void fill_spheres(Simulation& simulation, const scene::Scene& scene, Random& random);

/// The pours in the order of the scene, each with a random generator of its own. @throws SceneError
std::vector<Pour> build_pours(const scene::Scene& scene, const Model& model, Random& random);

/// A pour without its place: what it pours, how much and how fast.
/// @param key its path, for errors; @throws SceneError
Pour build_source(const scene::PourTable& table, const std::string& key, const Materials& materials);

/// The radius of each sphere that the file of a fill lists [m]: the file's own, or else that of the fill's diameter.
/// @param key the path of the fill, for errors; @throws SceneError where it has none, or both
std::vector<double> radii_from_file(const scene::FillTable& table, const std::string& key);

} // namespace talus
