// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/impact.hpp"
#include "tests/support/world.hpp"

#include <cmath>

// Impacts 5 to 8 of Chung & Ooi, Granular Matter 13 (2011) 643, in the closed forms of a rigid contact (3 is in
// test_bounce.cpp, 4 in test_oblique_impact.cpp; 1 and 2 are about the course of an elastic force). One contact, solved
// exactly: 1e-10 is what the benchmark asks, round-off what is found.

namespace talus::test
{
namespace
{

constexpr double tolerance = 1e-10;

// Tests 6 to 8: e = 0.5, μ = 0.4, r = 0.1 m, v_n = 0.2 m/s and spins that slip above r ω₀ = 7/2 μ (1 + e) v_n = 0.42
// m/s.
constexpr double restitution = 0.5;
constexpr double friction = 0.4;
constexpr double radius = 0.1;
constexpr double speed = 0.2;

/// v_t' and ω' of the sphere: 0.12 m/s and ω₀ − 3 rad/s if it slips, else it rolls away with 2/7 of its spin.
struct SpinImpact {
    double tangential, spin;
};

SpinImpact expected_after(double spin)
{
    const bool slips = radius * spin > 0.42;
    return slips ? SpinImpact{0.12, spin - 3.0} : SpinImpact{2.0 / 7.0 * radius * spin, 2.0 / 7.0 * spin};
}

} // namespace

TEST_CASE(
    "a fast oblique impact of an elastic sphere slips above 7 μ v_n of tangential speed", "[friction][restitution]")
{
    // Test 5: r = 10 µm, e = 1, μ = 0.3, v_n = 5 m/s. Slip keeps μ (1 + e) v_n = 3 m/s: r ω' = min(5/7 v_t, 7.5 m/s).
    const double tangential = GENERATE(0.1, 1.0, 5.0, 10.4, 10.6, 20.0, 70.0);
    const double micrometre = 1e-6;
    const World world = impact_on_plane({5.0, tangential, 0.0}, 0.3, 1.0, 10 * micrometre, rigid_settings());
    const double rim = world.angular_velocity().y() * world.radius();
    CHECK(world.velocity().z() == within(tolerance, 5.0));
    CHECK(rim == within(tolerance, std::min(5.0 / 7.0 * tangential, 7.5)));
    CHECK((slip(world).x() > tolerance * tangential) == (tangential > 10.5));
}

TEST_CASE("a spinning sphere that falls on a plane jumps forward", "[friction][restitution][spin]")
{
    // Test 6.
    const double spin = GENERATE(0.175, 2.0, 4.15, 4.25, 10.0, 22.0);
    const World world = impact_on_plane({speed, 0.0, radius * spin}, friction, restitution, radius, rigid_settings());
    const auto expected = expected_after(spin);
    CHECK(world.velocity().x() == within(tolerance, expected.tangential));
    CHECK(world.angular_velocity().y() == within(tolerance, expected.spin));
}

TEST_CASE(
    "two equal spheres with spins of one sense throw each other aside symmetrically", "[friction][restitution][spin]")
{
    // Test 7: J_n = (1 + e) m/2 · 2 v_n is that of test 6, the slip 2 r ω₀ of half the mass too: the same limit and
    // result.
    const double spin = GENERATE(0.175, 2.0, 4.15, 4.25, 10.0, 22.0);
    ContactLaw law;
    law.friction = friction;
    law.restitution = restitution;
    World world = make_world(law, rigid_settings(), 1e-4);
    world.model.gravity = Vec3::Zero();
    world.add_sphere(Vec3(0, 0, radius), Vec3(0, 0, -speed), Vec3(0, spin, 0), radius);
    world.add_sphere(Vec3(0, 0, -radius), Vec3(0, 0, speed), Vec3(0, spin, 0), radius);
    world.step();
    const auto expected = expected_after(spin);
    for (const int id : {0, 1}) {
        CHECK(std::abs(world.velocity(id).x()) == within(tolerance, expected.tangential));
        CHECK(world.angular_velocity(id).y() == within(tolerance, expected.spin));
    }
    CHECK(linear_momentum(world.state).norm() < 1e-15 * world.mass() * speed);
}

TEST_CASE("a heavy sphere at rest is as good as a plane", "[friction][restitution][spin]")
{
    // Test 8: r = 0.1 m against r = 0.5 m of 1000 times the density: the mass ratio m₁/m₂ = 8e-6 is the error of
    // "plane".
    const double spin = GENERATE(0.175, 2.0, 4.25, 10.0, 22.0);
    ContactLaw law;
    law.friction = friction;
    law.restitution = restitution;
    World world = make_world(law, rigid_settings(), 1e-4);
    world.model.gravity = Vec3::Zero();
    world.add_sphere(Vec3(0, 0, radius), Vec3(0, 0, -speed), Vec3(0, spin, 0), radius);
    world.add_sphere(Vec3(0, 0, -5 * radius), Vec3::Zero(), Vec3::Zero(), 5 * radius, 1000 * standard_density);
    world.step();
    const double mass_ratio = world.mass(0) / world.mass(1);
    REQUIRE(mass_ratio == within(1e-12, 8e-6));
    const auto expected = expected_after(spin);
    CHECK(world.velocity(0).z() == within(3 * mass_ratio, restitution * speed));
    CHECK(world.velocity(0).x() == within(3 * mass_ratio, expected.tangential));
    CHECK(world.angular_velocity(0).y() == within(3 * mass_ratio * spin / expected.spin, expected.spin));
}

} // namespace talus::test
