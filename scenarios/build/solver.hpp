// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"
#include "scenarios/build/accuracy.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// The law that a scene names.
Stabilisation stabilisation_of(const scene::SolverTable& table);

/// The settings of the solver, names replaced by numbers, but for the push-out speed.
/// @param setting for what the scene leaves open
/// @throws SceneError where the sweeps have no room
SolverSettings build_solver(const scene::Scene& scene, const RunSetting& setting);

/// The cap on the speed with which overlap is undone [m/s]. @param model its step is known too
double push_out_speed(const scene::Scene& scene, const Model& model);

} // namespace talus
