// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// What assembly learns of the contacts on its way.
struct ContactSurvey {
    std::size_t contacts = 0;
    std::size_t overlapping = 0;
    double worst_overlap = 0.0;  ///< [m]
    double overlap_sum = 0.0;    ///< over the overlapping contacts [m]
    double contact_energy = 0.0; ///< ½ k g² over the compliant contacts [J]

    ContactSurvey& operator+=(const ContactSurvey& other);
};

/// Turns the candidates that touch, or will within this step and a half, into the contacts of this step's problem:
/// normal, law (stabilisation.hpp), effective masses, and the impulse carried over, put back into the new tangent plane
/// and cone. Reads v⁽⁰⁾: gravity has not been added yet. Tiles in parallel, pistons after them.
/// @param walls as they stand now, with their velocity over the step
ContactSurvey assemble_contacts(
    ContactNetwork& network, const State& state, const Model& model, const std::vector<PlacedWall>& walls);

} // namespace talus
