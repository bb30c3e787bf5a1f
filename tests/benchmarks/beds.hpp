// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "core/simulation/simulation.hpp"

#include <functional>
#include <string>
#include <vector>

/// Real beds to measure on: spheres as a simulation has laid them.
///
/// A bed is simulated once, by the program itself, and kept as a checkpoint of places, sizes and velocities alone,
/// which any version of the core can begin with: what is measured before and after a change begins with the same
/// spheres. Large beds are copies of a smaller one, side by side along a periodic axis, so that every copy has its own
/// inside.
namespace talus::bench
{

/// A bed and the scene in which it lies.
struct Bed {
    std::string name;       ///< also of its checkpoint
    scene::Scene beginning; ///< what is simulated …
    double until = 0.0;     ///< … up to this time [s]
    int copies = 1;         ///< along y
    bool of_scene = false;  ///< a shipped scene, which goes on at that time
};

/// What a benchmark changes in the scene of a bed.
using Change = std::function<void(scene::Scene&)>;

/// The bed of this name: rest_, flow_, drum_ or wide_, which is at rest with sizes of 1 to 3, with the count 4k, 32k,
/// 250k or 1M; smooth_4k and smooth_32k, at rest without friction; w3_5000 and w3_20000; or a shipped scene.
Bed find_bed(const std::string& name);

/// The bed as it goes on, after as many steps as its contacts need to find their forces.
Simulation open_bed(const std::string& name, const Change& change = {});

} // namespace talus::bench
