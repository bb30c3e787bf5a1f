// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/simulation.hpp"
#include "scenarios/scene.hpp"

#include <algorithm>

namespace talus
{

/// The step of a run, and what it was chosen from.
struct StepChoice {
    double step = 0.0;          ///< h [s]
    bool given = false;         ///< by the scene
    double gravity_share = 0.0; ///< of √(d_min/gravity) in `by_gravity`
    double by_gravity = 0.0;    ///< the longest step that gravity allows; without gravity infinite [s]
    double by_speed = 0.0;      ///< the longest in which the fastest sphere moves 0.1 d_min [s]
    double fastest_speed =
        0.0; ///< that the scene can produce: starts, inlets, walls, the longest fall; pistons without gravity [m/s]
    double speed_limit = 0.0; ///< what is faster is a blow-up [m/s]

    double automatic() const { return std::min(by_gravity, by_speed); }
};

/// The step of the scene: the one given, or h = 0.0072 √(d_min/gravity) times the factor, and no longer than the time
/// in which the fastest sphere moves 0.1 d_min. Without gravity the speeds alone decide.
/// @param simulation its spheres are there; @param factor what an accuracy asks for
/// @throws SceneError where neither gravity nor a speed gives a step
StepChoice choose_step(const scene::Scene& scene, const Simulation& simulation, double factor = 1.0);

} // namespace talus
