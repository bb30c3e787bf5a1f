// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

namespace talus::test
{
namespace
{

constexpr double time_step = 1e-4;
constexpr double speed = 1.0;

/// n equal spheres in a row along x with these gaps; the first one moves towards the others.
World cradle(int n, double gap, double restitution)
{
    ContactLaw law;
    law.restitution = restitution;
    World world = make_world(law, rigid_settings(), time_step);
    world.model.gravity = Vec3::Zero();
    for (int k = 0; k < n; ++k)
        world.add_sphere(Vec3(k * (2 * standard_radius + gap), 0, 0), k == 0 ? Vec3(speed, 0, 0) : Vec3::Zero());
    return world;
}

} // namespace

TEST_CASE("touching spheres of a cradle take an impact all at once", "[restitution][cradle]")
{
    // The law implemented is Moreau's: Newton's rule for all contacts of a step together. u₁' = −e u₁, the others keep
    // u = 0, momentum is kept: v₁ = −(n − 2)/n, all others 2/n for e = 1. (Real steel balls, or one impact after the
    // other, give 0, …, 0, 1: the next test.) Tolerance: a converged chain of n contacts.
    const int n = GENERATE(2, 3, 5);
    World world = cradle(n, 0.0, 1.0);
    world.step();
    REQUIRE(world.report.solve.converged);
    CHECK(world.velocity(0).x() == Approx(-(n - 2.0) / n * speed).margin(1e-11));
    for (int k = 1; k < n; ++k) CHECK(world.velocity(k).x() == within(1e-11, 2.0 / n * speed));
    CHECK(kinetic_energy(world.state) == within(1e-11, 0.5 * world.mass() * speed * speed));
}

TEST_CASE("spheres of a cradle with gaps pass the impact on to the last", "[restitution][cradle]")
{
    // Gaps of more than V h, which no sphere crosses in the step of its own impact, make it a chain of binary impacts,
    // each of which swaps two velocities to round-off.
    const int n = GENERATE(3, 5);
    World world = cradle(n, GENERATE(1.001, 1.7) * speed * time_step, 1.0);
    world.step(20);
    for (int k = 0; k < n - 1; ++k) CHECK(std::abs(world.velocity(k).x()) < 1e-14);
    CHECK(world.velocity(n - 1).x() == within(1e-14, speed));
}

TEST_CASE("touching spheres without restitution move on together", "[restitution][cradle]")
{
    const int n = GENERATE(2, 3, 5);
    World world = cradle(n, 0.0, 0.0);
    world.step();
    REQUIRE(world.report.solve.converged);
    for (int k = 0; k < n; ++k) CHECK(world.velocity(k).x() == within(1e-11, speed / n));
}

} // namespace talus::test
