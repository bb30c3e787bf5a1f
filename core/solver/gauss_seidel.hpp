// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/solver/piston_group.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// How a solve went.
struct SolveReport {
    int sweeps = 0;
    double residual = 0.0; ///< ε
    bool converged = true; ///< ε as small as it should be

    void then(const SolveReport& next); ///< the next sub-step: all sweeps, the worst residual
};

/// Warm start: v ← v + M⁻¹ Gᵀ λ⁰ with the impulses in the contacts (METHOD (5); the note forgets it).
/// Notes v⁽¹⁾, with which the spheres come.
void apply_warm_start(
    ContactNetwork& network, PistonGroup& pistons, std::vector<Body>& bodies, const ModelledPhysics& physics);

/// This share of a tolerance, but no less than a tenth of it, and not below 1e-3.
double tightened(double tolerance, double share);

/// ω of a sweep of a step, METHOD (6): of its contacts, but for those with pistons.
/// @param sweep from 0 on
double relaxation_of(int sweep, const ModelledPhysics& physics, const SolverSettings& solver);

/// So many sweeps of projected Gauss–Seidel, as below, whatever the residual. Returns ε of the changes of
/// the last; without one, infinity.
double sweep_contacts(int count, ContactNetwork& network, PistonGroup& pistons, std::vector<Body>& bodies,
    const ModelledPhysics& physics);

/// Projected Gauss–Seidel (Algorithm 3.1 of the note) on the contacts of the network: sweeps tile colour by tile
/// colour, the tiles of one colour in parallel, and the pistons after them, until
///
///   ε = (Σ W|δ|² / Σ W|λ|²)^½ ≤ tolerance,  δ the exact correction of one contact alone,  METHOD (9)
///
/// but at least min_sweeps and at most max_sweeps. With `matched` ε shall be so small, too, that errors of velocities
/// are no more than seven tolerances of what contacts have changed of them, (Σ W|δ|² / Σ m|v − v⁽¹⁾|²)^½; but for that
/// no less than a tenth of the tolerance, nor than 1e-3. The changes made by the sweeps tell when ε may be small
/// enough; then a pass that changes nothing measures ε itself, and the sweeps go on if it is not.
/// To the end they go until ε ≤ tolerance · min(1, 2 (1 − ρ)), ρ what the last sweep has changed of what the one before
/// it did.
/// @param sweeps_made sweeps of this step that were made before, and count
SolveReport solve_contacts(ContactNetwork& network, PistonGroup& pistons, std::vector<Body>& bodies,
    const ModelledPhysics& physics, const SolverSettings& solver, int sweeps_made = 0);

} // namespace talus
