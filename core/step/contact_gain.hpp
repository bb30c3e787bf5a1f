// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// The energy that single contacts gained in a step [J]: contacts take energy, or give back what their springs had. So
/// what the bodies have more than they would without one contact's impulse, all others as they are, less what its
/// spring gave on a way of h u_n and what a moving wall put in, is a gain where it is above 0. What others lose is not
/// set against it. A jammed contact has no spring: what it pushes out is a gain. Contacts with pistons are left out.
/// @pre the spheres have not been moved, nor impulses carried; the step is not split
double contact_gain(const ContactNetwork& network, const State& state, const Model& model, double h);

} // namespace talus
