// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

namespace talus::test
{

/// Velocity of a sphere in the plane of its impact on a floor [m/s].
struct ImpactVelocity {
    double normal;     ///< towards the floor
    double tangential; ///< of the centre, along x
    double rim;        ///< r ω about y: the sphere rolls when it equals `tangential`
};

/// What the law of a rigid Coulomb contact without tangential restitution leaves (solid sphere, per unit mass):
/// J_n = (1 + e) v_n; J_t takes the slip s = v_t − r ω away, 2/7 |s|, unless that is more than μ J_n.
ImpactVelocity rigid_impact(const ImpactVelocity& before, double friction, double restitution);

/// A world without gravity after the one step in which a sphere (id 0), touching the floor z = 0, hits it.
World impact_on_plane(
    const ImpactVelocity& before, double friction, double restitution, double radius, const SolverSettings& solver);

} // namespace talus::test
