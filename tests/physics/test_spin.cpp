// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

namespace talus::test
{
namespace
{

ContactLaw sticky()
{
    ContactLaw law;
    law.friction = 0.8;
    law.rolling_friction = 0.1;
    law.restitution = 0.5;
    return law;
}

} // namespace

TEST_CASE("spin about the contact normal lasts for ever", "[spin][friction][rolling]")
{
    // A contact point has no lever about its own normal, and rolling resistance takes only the spin across it.
    // Tangential and rolling impulses are computed at right angles to n: 10⁴ steps leave their round-off.
    const double spin = 40.0;
    World world =
        sphere_on_plane(sticky(), GENERATE(rigid_settings(), matched_settings()), 1e-3, Vec3::Zero(), Vec3(0, 0, spin));
    world.step(10000);
    CHECK(world.angular_velocity().z() == within(1e-12, spin));
    CHECK(world.velocity().norm() < 1e-12);
}

TEST_CASE("a sphere that rolls keeps the spin about its contact normal", "[spin][friction]")
{
    const double spin = 40.0;
    ContactLaw law;
    law.friction = 0.3;
    World world =
        sphere_on_plane(law, GENERATE(rigid_settings(), matched_settings()), 1e-3, Vec3(1, 0, 0), Vec3(0, 0, spin));
    world.step(1000);
    CHECK(world.angular_velocity().z() == within(1e-12, spin));
    CHECK(world.velocity().x() == within(1e-12, 5.0 / 7.0)); // and its speed is that of a sphere without it
    CHECK(std::abs(world.velocity().y()) < 1e-12);
}

TEST_CASE("a head-on impact leaves the spins about the line of centres alone", "[spin][friction][restitution]")
{
    // Slip and spin across the normal are zero, so friction and rolling resistance have nothing to act on.
    World world = make_world(sticky(), rigid_settings(), 1e-4);
    world.model.gravity = Vec3::Zero();
    const Vec3 axis = Vec3(1, 2, -1).normalized();
    world.add_sphere(-standard_radius * axis, 0.5 * axis, 30 * axis);
    world.add_sphere(standard_radius * axis, -0.5 * axis, -70 * axis);
    world.step();
    CHECK((world.angular_velocity(0) - 30 * axis).norm() < 1e-11); // round-off of ω = a/r, a ~ 0.3 m/s
    CHECK((world.angular_velocity(1) + 70 * axis).norm() < 1e-11);
    CHECK(world.velocity(0).dot(axis) == within(1e-12, -0.25));
}

} // namespace talus::test
