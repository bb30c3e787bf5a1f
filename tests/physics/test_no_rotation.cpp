// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr double friction = 0.3;
constexpr double time_step = 1e-3;
constexpr double a_little = 0.005; // rad

/// A sphere that does not turn, on an incline of this angle; downhill is x.
World block_on_incline(double angle, const SolverSettings& solver)
{
    World world = sphere_on_plane({.friction = friction}, solver, time_step);
    world.model.physics.spin = false;
    world.model.gravity = standard_gravity * Vec3(std::sin(angle), 0, -std::cos(angle));
    return world;
}

} // namespace

TEST_CASE("a sphere that does not turn sticks to an incline when tan θ ≤ μ", "[friction][spin]")
{
    const double angle = GENERATE(0.1, std::atan(friction) - a_little);
    World world = block_on_incline(angle, GENERATE(rigid_settings(), matched_settings()));
    world.step(200);
    const double x = world.position().x();
    world.step(500);
    CHECK(std::abs(world.position().x() - x) < 1e-12);
    CHECK(world.velocity().norm() < 1e-12);
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    CHECK(forces[0].tangent_force.norm() / forces[0].normal_force == within(1e-9, std::tan(angle)));
}

TEST_CASE(
    "a sphere that does not turn slides down an incline with g (sin θ − μ cos θ) when tan θ > μ", "[friction][spin]")
{
    const double angle = GENERATE(std::atan(friction) + a_little, 0.8, 1.4);
    World world = block_on_incline(angle, GENERATE(rigid_settings(), matched_settings()));
    world.step(200);
    const double speed = world.velocity().x();
    world.step(300);
    CHECK((world.velocity().x() - speed) / (300 * time_step) ==
          within(1e-9, standard_gravity * (std::sin(angle) - friction * std::cos(angle))));
    CHECK(world.angular_velocity() == Vec3::Zero());
}

TEST_CASE(
    "an oblique impact without rotation stops the slip or takes μ (1 + e) of the normal speed", "[friction][spin]")
{
    // Without spin the whole mass resists the slip, not 2/7 of it: it sticks up to tan θ = μ (1 + e).
    const double restitution = 0.5, normal = 1.0;
    const double limit = friction * (1.0 + restitution) * normal;
    const double tangential = GENERATE_COPY(0.5 * limit, 0.999 * limit, 1.001 * limit, 3.0 * limit);
    World world = sphere_on_plane({.friction = friction, .restitution = restitution},
        GENERATE(rigid_settings(), matched_settings()), 1e-6, Vec3(0, tangential, -normal));
    world.model.gravity.setZero();
    world.model.physics.spin = false;
    world.step();
    CHECK(world.velocity().y() == Approx(std::max(0.0, tangential - limit)).margin(1e-12));
    CHECK(world.velocity().z() == within(1e-12, restitution * normal));
    CHECK(world.angular_velocity() == Vec3::Zero());
}

TEST_CASE("two spheres that do not turn share their slip where they stick", "[friction][spin]")
{
    World world = make_world({.friction = 5.0}, GENERATE(rigid_settings(), matched_settings()), 1e-6);
    world.model.gravity.setZero();
    world.model.physics.spin = false;
    world.add_sphere(Vec3::Zero(), Vec3(1, 0.5, -0.25));
    world.add_sphere(
        Vec3(2 * standard_radius, 0, 0), Vec3::Zero(), Vec3::Zero(), standard_radius, 3 * standard_density);
    world.step();
    // A plastic collision of one mass with three: both go on with a quarter of the velocity.
    for (const int id : {0, 1}) CHECK((world.velocity(id) - 0.25 * Vec3(1, 0.5, -0.25)).norm() < 0.2);
    CHECK((world.velocity(0) - world.velocity(1)).tail<2>().norm() < 1e-12);
    CHECK((0.25 * world.velocity(0) + 0.75 * world.velocity(1) - 0.25 * Vec3(1, 0.5, -0.25)).norm() < 1e-12);
}

} // namespace talus::test
