// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/builder/step_choice.hpp"

#include <string>

namespace talus
{

/// What decides how wrong a run is, and how long it takes.
struct RunSetting {
    StepTargets targets;
    double tolerance = 1e-2;
};

/// The settings, and why they are not the usual ones.
struct SolverChoice {
    SolverSettings settings;
    std::string explanation; ///< one line; empty where they are
};

/// The law that a scene names; where it leaves it open, the usual one.
Stabilisation stabilisation_of(const scene::SolverTable& table);

/// The settings of the solver as far as the table says, names replaced by numbers.
/// @param setting for what the scene leaves open
/// @throws SceneError where the sweeps have no room, and where pressure scaling is asked for with `matched`, whose
/// contacts are too soft for it to matter
SolverSettings build_solver(const scene::SolverTable& table, const RunSetting& setting);

/// These settings with what the scene leaves to the spheres.
///
/// Where spheres stand 150 mean diameters high, or one has 50 000 times the mass of another, contacts are rigid if
/// nothing flows or moves as prescribed. Where there is restitution and no gravity, the tolerance is 1e-3. Not so where
/// the scene says what it wants, or asks for an accuracy. Where one has more than five times the mass of another, the
/// tolerance is as much smaller, down to 1e-3, unless the scene gives one.
///
/// Pressure is scaled with `projected` in a bed of forty grains or more, or where something rests on grains of a tenth
/// of its mass or less; where no axis is periodic. Beds of a hundred grains or more then take at least six sweeps a
/// step, unless the scene says how many.
/// @param simulation its spheres are there, and its model has all but solver and step
SolverChoice complete_solver(
    SolverSettings solver, const scene::Scene& scene, const Simulation& simulation, const BedMeasures& bed);

/// The cap on the speed with which overlap is undone: the scene's, or what follows from gravity, or else from the step.
double push_out_speed(const scene::SolverTable& table, const Model& model);

} // namespace talus
