// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// Whether pressure is scaled in this run. Where the scene leaves it open: with `projected`, in a bed of ten grains or
/// more, or where something rests on grains of a tenth of its mass or less; where no axis is periodic.
/// @throws SceneError where it is asked for with `matched`, whose grains are too soft for it to matter
bool choose_pressure_scaling(const scene::Scene& scene, const Simulation& simulation);

} // namespace talus
