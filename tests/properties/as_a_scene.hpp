// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

namespace talus::test
{

/// Gives the world the settings that a scene with these walls and spheres gets which asks for nothing but a law: step,
/// sweeps, tolerance, push-out speed. What finds them for scenes finds them here, so that mass ratios and speeds have
/// their say. Where impacts as slow as this matter, 45 times the slowest that is one, 3 h |gravity|, with the usual
/// step, the scene asks for an accuracy of 1 %, as METHOD's limits advise.
void set_as_a_scene(World& world, Stabilisation law, double slowest_impact = infinity);

/// As above, with no settings yet: gravity, one law for all contacts.
World empty_world(const ContactLaw& law, bool gravity = true);

} // namespace talus::test
