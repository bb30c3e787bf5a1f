// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/builder/step_choice.hpp"
#include "scenarios/scene.hpp"

#include <string>
#include <vector>

namespace talus
{

/// What there is to tell of a simulation that was built, a line each.
struct BuildReport {
    std::string accuracy;                   ///< what the scene's accuracy picked; empty where it asks for none
    std::string solver;                     ///< what the spheres decided of the solver; empty where it is as usual
    std::string step;                       ///< where the time step comes from
    std::string model;                      ///< what the run models and what it leaves out
    std::string world;                      ///< the bounds that no sphere may leave
    std::string files;                      ///< what was taken of files of spheres, and what was not; else empty
    std::string overlap;                    ///< how stiff contacts are at most, and the overlap that it implies
    std::vector<std::string> warnings = {}; ///< what the scene asks for and hardly means
};

/// Where the step comes from. @param d the smallest diameter [m]
std::string explain_step(const StepChoice& choice, double d);

/// What the run models, and what it leaves out because nothing in the scene needs it.
std::string explain_model(const Model& model);

/// What was taken of the files of spheres that a scene names.
std::string explain_files(const scene::Scene& scene);

/// The bounds of the world: "x from -1 to 1, y without end, z from 0 up, in m".
std::string explain_world(const Box& world);

/// How soft `matched` makes contacts, k = 2.2 N_min/(W h²), and what overlap the bed will have for it, mean/d ≈
/// 0.45 Z g h²/(N_min d), Z the depth whose weight it bears, in diameters.
std::string forecast_overlap(const Simulation& simulation, const Bed& bed);

/// A step far above the automatic one, lattices that will stand as they are laid, walls far larger than the spheres,
/// and what meshes leave out.
std::vector<std::string> warnings_of(const scene::Scene& scene, const StepChoice& choice, const Model& model);

} // namespace talus
