// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

#include <string>

namespace talus
{

struct StepChoice {
    double step = 0.0;          ///< h [s]
    double fastest_speed = 0.0; ///< that the scene can produce: starts, inlets, walls, pistons, the longest fall [m/s]
    std::string explanation;    ///< one line
};

/// The step of the scene: the one given, or h = 0.008 √(d_min/gravity) times the factor, and no longer than the time in
/// which the fastest sphere moves 0.1 d_min. Without gravity the speeds alone decide.
/// @param factor what an accuracy asks for
/// @throws SceneError where neither gravity nor a speed gives a step
StepChoice choose_step(const scene::Scene& scene, const Simulation& simulation, double factor = 1.0);

/// Before the run: how soft `matched` makes contacts, k = 2.2 N_min/(W h²), and what overlap the bed will have for it,
/// mean/d ≈ 0.4 Z g h²/(N_min d), Z its height in diameters.
std::string forecast_overlap(const Simulation& simulation);

} // namespace talus
