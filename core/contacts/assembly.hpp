// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/contact_survey.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"
#include "core/world/step_length.hpp"

namespace talus
{

/// Turns the candidates that touch, or will within this step and a half, into the contacts of this step's problem:
/// normal, law (core/law), effective masses, and the impulse carried over, put back into the new tangent plane
/// and cone. Reads v⁽⁰⁾: gravity has not been added yet. Tiles in parallel, pistons after them.
/// @param walls as they stand now, with their velocity over the step
ContactSurvey assemble_contacts(ContactNetwork& network, const State& state, const Model& model, const StepLength& step,
    const std::vector<PlacedWall>& walls);

} // namespace talus
