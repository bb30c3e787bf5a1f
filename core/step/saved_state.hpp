// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// Refuses a state that was put back and with which no step could be made: lists of different lengths, indices that
/// point nowhere, numbers that are none.
/// @throws ArchiveError
void require_whole(const State& state, const ContactNetwork& contacts, const Model& model);

} // namespace talus
