// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/law/impact.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// Gives the contacts of spheres that have impacts the law that they have beside these, METHOD (4): those without a
/// load are deferred to the next step, those with one bear.
/// @return the greatest ratio of a mass that strikes a sphere to the sphere's, where another contact of it bears, and
/// beyond `most_impact_ratio` of what is as heavy on both sides of it; 0: none
double stand_beside_impacts(ContactNetwork& network, const State& state, const Model& model, const LawOfStep& step);

} // namespace talus
