// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/deck_basis.hpp"

namespace talus
{

/// The deck for LAMMPS, without its head.
Deck lammps_deck(const DeckBasis& basis);

} // namespace talus
