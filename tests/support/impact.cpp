// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/impact.hpp"

#include <algorithm>
#include <cmath>

namespace talus::test
{

ImpactVelocity rigid_impact(const ImpactVelocity& before, double friction, double restitution)
{
    const double slip = before.tangential - before.rim;
    const double normal_impulse = (1.0 + restitution) * before.normal;
    const double tangent_impulse = std::copysign(std::min(friction * normal_impulse, 2.0 / 7.0 * std::abs(slip)), slip);
    return {-restitution * before.normal, before.tangential - tangent_impulse, before.rim + 2.5 * tangent_impulse};
}

World impact_on_plane(
    const ImpactVelocity& before, double friction, double restitution, double radius, const SolverSettings& solver)
{
    ContactLaw law;
    law.friction = friction;
    law.restitution = restitution;
    const Vec3 velocity(before.tangential, 0, -before.normal);
    World world = sphere_on_plane(law, solver, 1e-6, velocity, Vec3(0, before.rim / radius, 0), radius);
    world.model.gravity = Vec3::Zero();
    world.step();
    return world;
}

} // namespace talus::test
