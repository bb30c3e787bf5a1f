// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// In sub-steps walls have the last word: what lies deeper in one than a quarter of the smallest diameter, pressed by
/// heavier or faster spheres than the sweeps can stop, is brought back to that depth, so that no centre comes to the
/// other side.
/// @param walls as they stood when the step began
/// @return by what spheres were lifted [J]
double hold_at_walls(
    const ContactNetwork& network, State& state, const Model& model, const std::vector<PlacedWall>& walls);

} // namespace talus
