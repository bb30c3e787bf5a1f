// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double h = 1e-4, r = standard_radius;

/// A ball that comes down on another one, askew, half a step before they touch. The lower one (id 0) lies on a floor or
/// falls freely.
World about_to_meet(bool on_floor)
{
    World world = make_world({.restitution = 0.5}, production_settings(Stabilisation::matched), h);
    world.add_sphere(Vec3(0, 0, r));
    if (on_floor) world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.step(100);
    const Vec3 normal(0.6, 0, 0.8), velocity = world.velocity() + Vec3(0.2, 0, -1.4); // −normal and as fast across it
    world.add_sphere(world.position() + 2.0 * r * normal - 0.5 * h * (velocity - world.velocity()), velocity);
    return world;
}

ContactForce impact_of(const World& world)
{
    for (const ContactForce& force : world.contact_forces())
        if (!force.with_wall) return force;
    FAIL("they do not meet");
    return {};
}

} // namespace

TEST_CASE("two that meet no one else meet at their instant, with gravity too", "[flight]")
{
    World world = about_to_meet(false);
    const Vec3 apart = world.position(1) - world.position(0), closing = world.velocity(1) - world.velocity(0);
    world.step();
    const ContactForce impact = impact_of(world);
    const Vec3 from_0_to_1 = impact.a == 1 ? impact.normal : Vec3(-impact.normal);
    CHECK((from_0_to_1 - (apart + 0.5 * h * closing) / (2.0 * r)).norm() < 1e-12);
    CHECK(impact.arm_scale == within(1e-12, 1.0));
    CHECK((world.position(1) - world.position(0) - apart - 0.5 * h * (closing + world.velocity(1) - world.velocity(0)))
              .norm() < 1e-12 * r);
}

TEST_CASE("a ball that falls on one that lies meets it where their paths do, but both have new velocities all the step",
    "[flight]")
{
    World world = about_to_meet(true);
    const Vec3 x = world.position(1), apart = x - world.position(0), closing = world.velocity(1) - world.velocity(0);
    world.step();
    const ContactForce impact = impact_of(world);
    const Vec3 from_0_to_1 = impact.a == 1 ? impact.normal : Vec3(-impact.normal);
    CHECK((from_0_to_1 - (apart + 0.5 * h * closing) / (2.0 * r)).norm() < 1e-12);
    CHECK(impact.arm_scale == within(1e-12, 1.0));
    CHECK((world.position(1) - x - h * world.velocity(1)).norm() < 1e-12 * r);
}
