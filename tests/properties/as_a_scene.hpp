// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

namespace talus::test
{

/// Gives the world the settings that a scene with these walls and spheres gets which asks for nothing but a law: step,
/// sweeps, tolerance, push-out speed. What finds them for scenes finds them here, so that mass ratios and speeds have
/// their say.
void set_as_a_scene(World& world, Stabilisation law);

/// As above, with no settings yet: gravity, one law for all contacts.
World empty_world(const ContactLaw& law, bool gravity = true);

} // namespace talus::test
