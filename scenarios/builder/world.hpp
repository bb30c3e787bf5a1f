// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"
#include "scenarios/builder/spheres.hpp"

namespace talus
{

/// The smallest, largest and mean diameter of all spheres that the scene makes, into the model.
/// @pre the model has its materials
/// @throws SceneError where it makes none
void find_diameters(Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours);

/// The periodic axes, from the corners of the world.
/// @param max_diameter of the spheres [m]
/// @throws SceneError where a corner is not given or the cell is shorter than 2.2 of the largest spheres
Periodicity build_periodicity(const scene::WorldTable& table, double max_diameter);

/// Whether a place is near enough to the origin for numbers to tell places apart, and for cells to be counted.
/// @param diameter of the spheres [m]
bool is_within_reach(const Vec3& place, double diameter);

/// The box round walls, fills, pours and outlets as the scene begins, whatever its duration.
/// @pre the model has its walls, outlets and diameters
/// @throws SceneError where one of them lies too far from the origin
Box build_contents(const Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours);

/// The box that no sphere may leave, where the scene does not say: that of walls on their ways, fills, pours and
/// outlets, with planes that stand across an axis, grown by five diameters; open upwards, and to the sides where a
/// plane bears spheres, for they may roll on it as far as they can.
/// @pre the model has its gravity, walls, outlets and diameters
/// @throws SceneError where it is empty
Box build_world(
    const scene::Scene& scene, const Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours);

} // namespace talus
