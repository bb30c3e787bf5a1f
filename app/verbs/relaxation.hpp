// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/simulation.hpp"

namespace talus
{

/// How far overlap was undone before a run.
struct Relaxation {
    int steps = 0;
    OverlapCheck left;
};

/// Moves overlapping spheres apart, and out of walls, before a run begins: steps of the `projected` law without gravity
/// and with all velocities at zero, until the worst overlap is below 1e-6 d or 2000 steps were made. Only positions
/// change.
/// @param overlaps those that there are
Relaxation relax_overlaps(Simulation& simulation, const OverlapCheck& overlaps);

} // namespace talus
