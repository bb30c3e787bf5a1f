// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// A sphere in free flight that others meet in this step: it has impacts with spheres and no other contact. All its
/// impulses act at one instant τ, the mean of its impacts' own: until then it flies with v⁽¹⁾, after it with v.
struct Flight {
    std::int32_t sphere;
    double instant; ///< τ [s] since the beginning of the step; < 0 for impacts that the last step has missed
    Vec3 way;       ///< τ v⁽¹⁾ [m]
};

/// Finds the spheres in flight, and puts the impacts between spheres where both are at their own instants (at the
/// beginning of the step for those that are not in flight): normal, lever arms and target. Impulses along these arms
/// keep angular momentum, since positions go the same way (`move_flights`).
std::vector<Flight> place_impacts(ContactNetwork& network, const State& state, const Model& model, double h);

/// x ← x + τ v⁽¹⁾ + (h − τ) v, for spheres in flight that have been moved by h v.
void move_flights(const std::vector<Flight>& flights, State& state);

} // namespace talus
