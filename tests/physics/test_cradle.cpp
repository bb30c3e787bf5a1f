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

TEST_CASE("spheres of a cradle pass the impact on to the last, touching or apart", "[restitution][cradle]")
{
    // A chain of binary impacts, one a step, each of which swaps two velocities to round-off: 0, …, 0, 1, as steel
    // balls do. Moreau's law for all contacts of the step together would give 2/n to the last. Gaps of more than V h
    // are not crossed in the step of the impact before, lesser ones are.
    const int n = GENERATE(2, 3, 5);
    World world = cradle(n, GENERATE(0.0, 0.3, 0.9, 1.001, 1.7) * speed * time_step, 1.0);
    world.step(20);
    for (int k = 0; k < n - 1; ++k) CHECK(std::abs(world.velocity(k).x()) < 1e-14);
    CHECK(world.velocity(n - 1).x() == within(1e-14, speed));
}

TEST_CASE("an impact that meets a gap about to close is handed on in full", "[restitution][cradle]")
{
    // B goes at 0.25 m/s towards C, 0.3 mm away, and would be there after 1.2 steps; A hits B with 1 m/s in this step.
    World world = cradle(3, 0.0, 1.0);
    world.model.time_step = 1e-3;
    world.state.position[1].x() += 5e-4;
    world.state.position[2].x() += 8e-4;
    world.state.body(1).velocity.x() = 0.25;
    world.step(2);
    CHECK(world.velocity(0).x() == within(1e-14, 0.25));
    CHECK(std::abs(world.velocity(1).x()) < 1e-14);
    CHECK(world.velocity(2).x() == within(1e-14, 1.0));
}

TEST_CASE("touching spheres without restitution move on together", "[restitution][cradle]")
{
    const int n = GENERATE(2, 3, 5);
    // Impacts are handed on from sphere to sphere, a step for each.
    World world = cradle(n, 0.0, 0.0);
    world.step(40 * n);
    for (int k = 0; k < n; ++k) CHECK(world.velocity(k).x() == within(1e-3, speed / n));
}

} // namespace talus::test
