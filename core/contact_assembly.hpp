// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact_network.hpp"
#include "core/model.hpp"
#include "core/placed_wall.hpp"
#include "core/state.hpp"

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

/// What is handed on to the next step, read from the solved contacts.
struct ContactOutcome {
    double cone_violation = 0.0;      ///< worst |λ_t| − μ λ_n [N s], 0 if none
    Vec3 wall_impulse = Vec3::Zero(); ///< Σ λ over the contacts with walls that are not pistons [N s]
    double wall_work = 0.0;           ///< what moving walls did on the spheres, Σ λ·w and rolling rows likewise [J]
    std::size_t beyond_solution = 0;  ///< contacts that came to be so in this step (press.hpp)

    ContactOutcome& operator+=(const ContactOutcome& other);
};

/// Stores the impulses of the solved contacts in their slots (an impact carries none), counts for how long contacts
/// have been pressed, and notes each sphere's last wall.
ContactOutcome carry_impulses(ContactNetwork& network, State& state, const Model& model);

} // namespace talus
