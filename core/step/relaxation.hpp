// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// Moves overlapping spheres apart, and out of walls, before a run begins: steps of the `projected` law without gravity
/// and with all velocities at zero, until the worst overlap is below 1e-6 mean diameters or 2000 steps were made. Only
/// positions change.
/// @param worst_overlap that there is [m]
/// @return the steps made
int relax_overlaps(State& state, const Model& model, double worst_overlap);

} // namespace talus
