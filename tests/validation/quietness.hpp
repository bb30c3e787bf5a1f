// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/simulation.hpp"

namespace talus::test
{

/// How still a bed at rest is, over a window of time.
struct Quietness {
    double overlap = 0.0;       ///< mean overlap of the overlapping contacts / d
    double worst_overlap = 0.0; ///< worst overlap / d
    double creep = 0.0;         ///< median speed of the grains' displacement over the window [d/s]
    double restless = 0.0;      ///< kinetic energy per grain without the liveliest 2 %, / (m g d)
    double force_rms = 0.0;     ///< rms of the support force / weight − 1
    double height = 0.0;        ///< twice the height of the centre of mass above the lowest grain's foot [d]
    double sweeps = 0.0;        ///< mean per step …
    double least_sweeps = 0.0;  ///< … and N_min
};

Quietness watch(Simulation& simulation, double window);

} // namespace talus::test
