// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// A sphere that has impacts with others in this step and no other contact, with gravity one with one that has no
/// other: it flies with v⁽¹⁾ until it touches, at the instant τ, and with v after it. So an impact of two is exact: it
/// keeps momentum, angular momentum and energy. τ of several is their mean.
struct Flight {
    std::int32_t sphere;
    double instant; ///< τ [s] since the beginning of the step
    Vec3 way;       ///< τ v⁽¹⁾ [m]
};

/// Finds the spheres in flight. Their contacts are laid where they touch.
std::vector<Flight> find_flights(const ContactNetwork& network, const State& state, const Model& model, double h);

/// x ← x + τ v⁽¹⁾ + (h − τ) v, for spheres in flight that have been moved by h v. Returns by what that lifts
/// them: nothing, but where what they part from pushes one of a pair [J].
double move_flights(const std::vector<Flight>& flights, State& state, const Vec3& gravity);

} // namespace talus
