// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/simulation.hpp"

namespace talus
{

/// The fastest that a piston of the simulation becomes on its free way under its weight and load, from its release
/// until it meets the bed: that of the spheres there at the start, as if they lay packed as densely as spheres can.
/// Where one does not come from above, or spheres may leave, its way leads across all there is [m/s].
double fastest_piston(const Simulation& simulation);

} // namespace talus
