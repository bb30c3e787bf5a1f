// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact_network.hpp"
#include "core/diagnostics.hpp"
#include "core/model.hpp"
#include "core/press_count.hpp"
#include "core/state.hpp"

#include <vector>

namespace talus
{

/// An incident for each group of bodies that loaded contacts with a tenth of such an overlap join together, where a
/// contact came to be beyond solution in this step, and none of the group was before.
std::vector<Incident> find_presses(const ContactNetwork& network, const State& state, const Model& model);

} // namespace talus
