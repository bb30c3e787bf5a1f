// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/contacts/press_count.hpp"
#include "core/step/diagnostics.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// An incident for each group of bodies that loaded contacts with a tenth of such an overlap join together, where a
/// contact came to be beyond solution in this step, and none of the group was before.
std::vector<Incident> find_presses(const ContactNetwork& network, const State& state, const Model& model);

} // namespace talus
