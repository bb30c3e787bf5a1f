// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/tile_contacts.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// Makes the rolling rows of a pack whose contacts are made, METHOD (8), with what they carry put back into their
/// planes and disks.
/// @param carried rolling impulses of the step before, by slot [N m s]
void make_rolling_rows(TileContacts& contacts, std::size_t pack, bool with_walls, const std::vector<Vec3>& carried,
    const State& state, const Model& model);

} // namespace talus
