// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/simulation.hpp"

namespace talus
{

/// The most that any point of a moving wall ever moves at, as far as it lies where spheres may be [m/s]: what the parts
/// of a motion do at the same time is added up as if all of it had one direction. It does not matter when the run ends,
/// because one that goes on later must have the same step; only a wall that is pushed on for ever and turned then has
/// an arm that grows until the end.
double fastest_wall(const Simulation& simulation);

} // namespace talus
