// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/deck_basis.hpp"

namespace talus
{

/// The deck for LIGGGHTS, without its head.
Deck liggghts_deck(const DeckBasis& basis);

} // namespace talus
