// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact_network.hpp"
#include "core/state.hpp"

namespace talus
{

/// The position half of `projected`: one nonlinear Gauss–Seidel pass over the contacts, in which each overlapping pair
/// is moved apart by a share of its present overlap, in inverse proportion to the masses. Velocities do not change, so
/// overlap never becomes energy.
void project_positions(const ContactNetwork& network, State& state, const Periodicity& periodicity, double share);

} // namespace talus
