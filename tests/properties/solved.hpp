// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/properties/random_world.hpp"

namespace talus::test
{

/// Whether the step that was just made is solved: to its tolerance, or as far as the digits of the velocities go.
bool is_solved(const World& world, const StepReport& report);

/// That it is not, in words.
std::string told_unsolved(const RandomWorld& own, const StepReport& report);

/// Such worlds are always solved: without friction, masses up to 30 : 1.
inline bool must_be_solved(const RandomWorld& own)
{
    return own.is_frictionless() && own.mass_ratio() <= 30.0;
}

} // namespace talus::test
