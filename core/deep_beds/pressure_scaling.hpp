// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/solver/piston_group.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// How the corrections of a step went.
struct ScalingReport {
    int corrections = 0;  ///< asked for: one a step or sub-step in which anything is loaded and not at rest
    int refused = 0;      ///< of them, where the energy would have risen: nothing was changed
    double largest = 0.0; ///< max |t α|: 0.1 is a pressure corrected by a tenth
    int sweeps = 0;       ///< made before it

    void then(const ScalingReport& next); ///< the next sub-step
};

/// Pressure scaling: the impulses of all contacts are multiplied by a smooth positive field, METHOD (11)
///
///   λ ← θ λ,  θ = 1 + t Σ_s α_s φ_s(x_contact),   v ← v + M⁻¹ Gᵀ Δλ
///
/// with hats φ_s four diameters wide (hat_grid.hpp). Sweeps alone carry a change of load one contact further in each
/// sweep; the hats carry it through the whole bed at once, for a network of forces keeps its pattern where its
/// amplitude changes. Coulomb's cone is kept by any positive factor, and momentum, since v changes along.
///
/// α solves A α = −e, A_st = Σ_bodies F_s·M⁻¹F_t with F_s the impulses on a body weighted by φ_s, and e_s = Σ φ_s λ·y
/// over normal and sticking rows; it is held in [−0.8, 4]; t is the exact minimum along α of the energy ½ v·Mv − λ·q,
/// at most 1, and where the energy would rise, nothing is done. A solution is left as it is, for λ·y = 0 at each of its
/// contacts. Every few steps only, it makes forces swing.
ScalingReport scale_pressure(ContactNetwork& network, PistonGroup& pistons, State& state, const Model& model);

/// Pressures are corrected in a step, where the scene asks for it and sweeps alone would leave the load of the bed
/// wrong by more than a ten-thousandth: they carry it through n layers in some n² of them, and under a mass M on grains
/// of mass m in M/m. Two sweeps are made before, which take out of the way what is local: the power λ·y of impacts, and
/// of contacts about to open, is no lack of pressure. Right after the warm start, the scaling made a flow out of a
/// hopper overlap nine times as much, in half as many sweeps again.
ScalingReport correct_pressures(ContactNetwork& network, PistonGroup& pistons, State& state, const Model& model);

} // namespace talus
