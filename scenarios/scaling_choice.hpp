// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// How deep the bed of all spheres that the scene makes may become, in mean diameters: their volume, packed, over the
/// room that their fills and pours take across gravity. 0 without gravity.
double bed_depth(const Simulation& simulation);

/// Whether pressure is scaled in this run. Where the scene leaves it open: with `projected`, in a bed of ten grains or
/// more, or where something rests on grains of a tenth of its mass or less.
/// @throws SceneError where it is asked for with `matched`, whose grains are too soft for it to matter
bool choose_pressure_scaling(const scene::Scene& scene, const Simulation& simulation);

} // namespace talus
