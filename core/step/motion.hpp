// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

/// How bodies move in a step, METHOD (2) and (10), but for their contacts.
namespace talus
{

/// v⁽¹⁾ = v⁽⁰⁾ + h f / m of the spheres: gravity, and the forces of their own.
void add_forces(State& state, const Vec3& gravity, double h);

/// x ← x + h v. Spheres are round: their orientation is not kept. What does not fit into the digits of x is added in
/// the next step (Kahan's sum): at 1e6 diameters from the origin they end at 1e-10, and a sphere at constant speed
/// would lose half of that in every step, always the same way.
void move_spheres(State& state, double h);

/// Moves pistons along their guides with their velocity. Returns the work that their loads did on the way [J].
double move_pistons(State& state, const std::vector<Piston>& pistons, double h);

/// Spheres that have left the cell of periodic axes come in again on its other side.
void wrap_positions(State& state, const Periodicity& periodicity);

/// A sphere whose centre is inside an outlet leaves lawfully, even if it is out of the outlet again when it is taken
/// away.
void mark_leaving(State& state, const std::vector<Region>& outlets);

/// By how much impulses have changed the velocity of that sphere most that they have thrown furthest: |v − v⁽¹⁾| [m/s].
/// @param free_velocity v⁽¹⁾ by body
double farthest_throw(const State& state, const std::vector<Vec3>& free_velocity);

} // namespace talus
