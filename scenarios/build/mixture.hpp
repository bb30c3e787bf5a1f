// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/mixture.hpp"
#include "scenarios/scene.hpp"

#include <string>
#include <vector>

namespace talus
{

/// @param key the path of the diameter, for errors; @throws SceneError where the scene does not make diameters of it
SizeDistribution build_sizes(const scene::DiameterTable& table, const std::string& key);

/// What a fill or a pour is made of: its species, or its one material and diameter.
/// @param key the path of the fill or pour, for errors; @throws SceneError where it has not exactly one of the two
Mixture build_mixture(const scene::FillTable& table, const std::string& key, const Materials& materials);
Mixture build_mixture(const scene::PourTable& table, const std::string& key, const Materials& materials);

/// The names of all materials in a fill or a pour.
std::vector<std::string> materials_in(const scene::FillTable& table);
std::vector<std::string> materials_in(const scene::PourTable& table);

} // namespace talus
