// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/findings/force_profile.hpp"
#include "tests/support/world.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2.0 * standard_radius;

/// Spheres on top of each other, at rest; `up` says which way that is.
World tower(int count, const Vec3& up)
{
    World world = make_world({.friction = 0.5}, rigid_settings(), 2.5e-4);
    world.model.gravity = -standard_gravity * up;
    world.add_plane(Vec3::Zero(), up);
    for (int k = 0; k < count; ++k) world.add_sphere((standard_radius + k * d) * up);
    world.step(3);
    return world;
}

} // namespace

TEST_CASE("a cut through a tower at rest carries what lies above it, and the floor carries all", "[force_profile]")
{
    const Vec3 up = GENERATE(Vec3(0, 0, 1), Vec3(0, -1, 0));
    const World world = tower(6, up);
    // Between the feet, at whole diameters: the upper half of the lowest sphere is above none, the others as they lie.
    const ForceProfile cuts(world.state, up, 5);
    const auto forces = cuts.forces(world.state, world.network, world.report, world.model.time_step);
    const double weight = world.mass() * standard_gravity;
    REQUIRE(forces.size() == 6);
    for (int k = 0; k < 6; ++k) CHECK(forces[static_cast<std::size_t>(k)] == within(1e-9, (6 - k) * weight));
}

TEST_CASE("cuts and floor carry the same while steps are split for what is far off", "[force_profile][sub_steps]")
{
    World world = tower(6, Vec3::UnitZ());
    const ForceProfile cuts(world.state, Vec3::UnitZ(), 5);
    world.add_sphere(Vec3(1000, 0, 100), Vec3(40, 0, 0));
    world.add_sphere(Vec3(1000 + 2.02 * standard_radius, 0, 100));
    world.step();
    REQUIRE(world.report.sub_steps > 5);
    const auto forces = cuts.forces(world.state, world.network, world.report, world.model.time_step);
    const double weight = world.mass() * standard_gravity;
    for (int k = 0; k < 6; ++k) CHECK(forces[static_cast<std::size_t>(k)] == within(1e-9, (6 - k) * weight));
}

TEST_CASE("cuts stay where they were laid", "[force_profile]")
{
    World world = tower(4, Vec3::UnitZ());
    const ForceProfile cuts(world.state, Vec3::UnitZ(), 3);
    for (Vec3& x : world.state.position) x.z() += d;
    // The tower is a diameter higher: no force through the lowest cut, which it has left below.
    const auto forces = cuts.forces(world.state, world.network, world.report, world.model.time_step);
    CHECK(forces[1] == 0.0);
    CHECK(forces[2] == within(1e-9, 3 * world.mass() * standard_gravity));
}

TEST_CASE("a sphere that falls is held up by nothing", "[force_profile]")
{
    World world = make_world({.friction = 0.5}, rigid_settings(), 2.5e-4);
    world.add_sphere(Vec3(0, 0, 1.0));
    world.step();
    const ForceProfile cuts(world.state, Vec3::UnitZ(), 2);
    for (const double force : cuts.forces(world.state, world.network, world.report, world.model.time_step))
        CHECK(force == 0.0);
}
