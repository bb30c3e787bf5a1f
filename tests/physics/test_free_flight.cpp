// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr double large = 0.1; ///< a radius that no move in these steps comes near: they are not split [m]

} // namespace

TEST_CASE("a sphere in free flight follows the discrete parabola", "[free_flight]")
{
    // Symplectic Euler, v before x: v_n = v₀ + g h n, x_n = x₀ + v₀ n h + ½ g h² n (n + 1). No contact acts, so only
    // the round-off of n additions is left: n ε ~ 1e-13.
    const double h = 1e-3;
    const int n = 1000;
    const Vec3 position(0.1, -0.2, 3.0);
    const Vec3 velocity(1.0, 2.0, 3.0);
    World world = make_world({}, GENERATE(rigid_settings(), matched_settings()), h);
    world.model.gravity = Vec3(0.5, -1.0, -9.81);
    world.add_sphere(position, velocity, Vec3::Zero(), large);
    world.step(n);

    const Vec3 g = world.model.gravity;
    const Vec3 expected = position + velocity * n * h + 0.5 * g * h * h * n * (n + 1);
    CHECK((world.velocity() - (velocity + g * h * n)).norm() < 1e-12 * g.norm());
    CHECK((world.position() - expected).norm() < 1e-12 * expected.norm());
    CHECK(world.state.time == within(1e-12, n * h));
    CHECK(world.report.contacts.count == 0);
    CHECK(world.report.solve.converged);
}

TEST_CASE("far from the origin a slow sphere goes as far as anywhere", "[free_flight]")
{
    // A position of 1e4 m has digits of 1.8e-12 m; in a step the sphere goes 0.3 or 0.6 of one.
    constexpr double far = 1e4, digit = 0x1p-39, h = 1e-4;
    const double move = GENERATE(0.3, 0.6) * digit;
    World world = make_world({}, matched_settings(), h);
    world.model.gravity.setZero();
    world.add_sphere(Vec3(far, 0, 0), Vec3(move / h, 0, 0));
    world.step(1000);
    CHECK(std::abs(world.position().x() - far - 1000 * move) < digit);
}

TEST_CASE("free flight loses exactly ½ m g² h of energy per second to the time step", "[free_flight][energy]")
{
    // Per step ΔE = ½ m (v₁² − v₀²) + m g h v₁ with v₁ = v₀ − g h, which is −½ m g² h² whatever v₀.
    const double h = 1e-3;
    const int n = 500;
    World world = make_world({}, rigid_settings(), h);
    world.add_sphere(Vec3(0, 0, 2), Vec3(0, 0, 1), Vec3::Zero(), large);
    const auto energy = [&] {
        return kinetic_energy(world.state) + potential_energy(world.state, world.model.gravity);
    };
    const double before = energy();
    world.step(n);
    const double lost = 0.5 * world.mass() * standard_gravity * standard_gravity * h * (n * h);
    CHECK(before - energy() == within(1e-9, lost)); // 1e-9: the loss is 4e-4 of the energies whose difference it is
    CHECK(world.report.bodies.kinetic_energy == within(1e-12, kinetic_energy(world.state)));
    CHECK(world.report.bodies.potential_energy == within(1e-12, potential_energy(world.state, world.model.gravity)));
}

TEST_CASE("a sphere in free flight keeps its spin", "[free_flight][spin]")
{
    // A sphere has no gyroscopic term and nothing touches it: not one bit changes.
    const Vec3 spin(10, -20, 30);
    ContactLaw law;
    law.friction = 0.5;
    World world = make_world(law, rigid_settings(), 1e-3);
    world.add_sphere(Vec3::Zero(), Vec3(1, 0, 0), spin);
    const Vec3 before = world.angular_velocity();
    world.step(1000);
    CHECK(world.angular_velocity() == before);
}

TEST_CASE("spheres that do not touch do not see each other", "[free_flight]")
{
    // A gap that stays open allows u_n ≥ −g/h without any impulse, so a near miss is free flight to the last bit.
    ContactLaw law;
    law.friction = 1.0;
    World world = make_world(law, GENERATE(rigid_settings(), matched_settings()), 1e-4);
    world.model.gravity = Vec3::Zero();
    const double clearance = 1e-3 * standard_radius;
    const Vec3 velocity(1, 0, 0);
    world.add_sphere(Vec3(-0.02, 0, 2 * standard_radius + clearance), velocity, Vec3(0, 50, 0));
    world.add_sphere(Vec3::Zero());
    world.step(400);
    CHECK(world.velocity(0) == velocity);
    CHECK(world.velocity(1) == Vec3::Zero());
}

} // namespace talus::test
