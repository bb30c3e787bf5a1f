// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/builder/bed.hpp"

namespace talus
{

/// How fast a scene can make things.
struct SceneSpeeds {
    double closing = 0.0; ///< at which surfaces that will touch come nearer to each other [m/s]
    double highest = 0.0; ///< of anything, as it is seen from the scene's frame [m/s]
};

/// What starts, inlets, falls until something lands, and surfaces that move along their normals come to; without
/// gravity pistons, too, which may be all that moves. What goes side by side, or along a surface, does not close; the
/// velocity that all walls have in common counts for nothing.
SceneSpeeds scene_speeds(const Simulation& simulation, const Bed& bed);

} // namespace talus
