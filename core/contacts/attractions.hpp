// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/loads.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// Finds which contacts of a pack attract in this step, and with what impulse: those whose two have touched, and whose
/// gap has not exceeded the range since. Returns their energy as the step begins [J].
/// @param carried what their slots hold; @param h of the step [s]
double find_attractions(TileContacts& contacts, std::size_t pack, bool with_walls, const CarriedImpulses& carried,
    const State& state, const Model& model, double h);

/// v ← v − M⁻¹ Gᵀ c, METHOD (12): attraction is a force, as gravity is. That on pistons is theirs, below.
void apply_attractions(const ContactNetwork& network, std::vector<Body>& bodies);

/// Of the impulses of attraction, along the velocities of what they draw together [J]: half of it before a step and
/// half after it is the work of attraction, as that of gravity is counted.
double attraction_power(const ContactNetwork& network, const State& state, const Model& model);

/// What attraction does to each piston in this step, its torque about the piston's centre.
std::vector<WallLoad> attractions_of_pistons(const ContactNetwork& network, const Model& model);

} // namespace talus
