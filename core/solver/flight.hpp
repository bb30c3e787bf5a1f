// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// A sphere that meets one other in this step, which meets none but it: they fly with v⁽¹⁾ until they touch, at the
/// instant τ, and with v after it. So an impact of two is exact: it keeps momentum, angular momentum and energy.
struct Flight {
    std::int32_t sphere;
    double instant; ///< τ [s] since the beginning of the step
    Vec3 way;       ///< τ v⁽¹⁾ [m]
};

/// Finds the spheres in flight. Their contacts are laid where they touch.
std::vector<Flight> find_flights(const ContactNetwork& network, const State& state, const Model& model, double h);

/// x ← x + τ v⁽¹⁾ + (h − τ) v, for spheres in flight that have been moved by h v.
void move_flights(const std::vector<Flight>& flights, State& state);

} // namespace talus
