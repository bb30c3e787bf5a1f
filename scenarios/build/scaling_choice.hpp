// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// Settles whether pressure is scaled in this run. Where the scene leaves it open: with `projected`, in a bed of forty
/// grains or more, or where something rests on grains of a tenth of its mass or less; where no axis is periodic. Beds
/// of a hundred grains or more then take at least six sweeps a step, unless the scene says how many.
/// @throws SceneError where it is asked for with `matched`, whose grains are too soft for it to matter
void choose_pressure_scaling(const scene::Scene& scene, Simulation& simulation);

} // namespace talus
