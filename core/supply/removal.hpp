// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// Takes the spheres out for which `gone` is not 0; the others keep their order.
void remove_spheres(State& state, ContactNetwork& contacts, const Model& model, const std::vector<std::uint8_t>& gone);

} // namespace talus
