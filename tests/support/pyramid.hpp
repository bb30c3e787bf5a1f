// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

// A sphere on two (in a plane) or three others that stand on a floor with their centres s apart. No torque on a base
// sphere asks for equal friction above and below, which gives with the angle θ of the upper contacts from the vertical
//
//   N = m g / n,  T = N tan(θ/2),  floor N' = (1 + 1/n) m g,  T' = T        for n = 2 or 3 base spheres, any s > 2 r,
//
// so it stands if and only if μ ≥ tan(θ/2) above and μ ≥ tan(θ/2)/(n + 1) at the floor.

namespace talus::test
{

inline constexpr double ample_friction = 2.0; ///< holds anything here

double critical_friction_above(int n);
double critical_friction_at_floor(int n);

/// A pyramid of n base spheres, 2 or 3, with ids 0 … n−1, and the top one, n, at the automatic step.
World pyramid(int n, double friction_above, double friction_at_floor, const SolverSettings& solver);

} // namespace talus::test
