// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// The position half of `projected`, METHOD (10); nothing with `matched`: one nonlinear Gauss–Seidel pass over the
/// contacts, in which each overlapping pair is moved apart by `projected_share` of its present overlap, in inverse
/// proportion to the masses. Velocities do not change, so overlap never becomes energy of motion. A piston gives way
/// along its guide, after its release.
/// @param walls as they stood when the step began
/// @return by what spheres and pistons were lifted [J]
double project_positions(
    const ContactNetwork& network, State& state, const Model& model, const std::vector<PlacedWall>& walls);

} // namespace talus
