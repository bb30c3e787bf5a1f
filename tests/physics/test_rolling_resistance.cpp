// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

// Rolling and tangential rows of a sphere at a wall are coupled, so they need some hundred sweeps:
// laws hold to the solver's tolerance times that number rather than to round-off.
constexpr double solver_limited = 1e-9;
constexpr double time_step = 1e-3;

ContactLaw resistant(double friction, double rolling_friction)
{
    ContactLaw law;
    law.friction = friction;
    law.rolling_friction = rolling_friction;
    return law;
}

World sphere_on_incline(double angle, const ContactLaw& law, const SolverSettings& solver)
{
    World world = sphere_on_plane(law, solver, time_step);
    world.model.gravity = standard_gravity * Vec3(std::sin(angle), 0, -std::cos(angle));
    return world;
}

} // namespace

TEST_CASE("rolling resistance holds a sphere on an incline when tan θ ≤ μ_r", "[rolling]")
{
    // At rest friction T = m g sin θ turns the sphere with T r; resistance can take μ_r r m g cos θ.
    const double rolling_friction = 0.1;
    const double angle = std::atan(GENERATE(0.5, 0.99) * rolling_friction);
    World world =
        sphere_on_incline(angle, resistant(0.5, rolling_friction), GENERATE(rigid_settings(), matched_settings()));
    world.step(500); // `matched` rolls a little until it has sunk in and carries the whole weight
    const Vec3 position = world.position();
    world.step(500);
    CHECK(world.velocity().norm() < solver_limited * standard_gravity * time_step);
    CHECK((world.position() - position).norm() < solver_limited * standard_radius);
}

TEST_CASE("a sphere with rolling resistance rolls down with 5/7 g (sin θ − μ_r cos θ) when tan θ > μ_r", "[rolling]")
{
    // About the contact line: 7/5 m a = m g sin θ − μ_r m g cos θ.
    const double rolling_friction = 0.1;
    const double angle = std::atan(GENERATE(1.01, 2.0) * rolling_friction);
    World world =
        sphere_on_incline(angle, resistant(0.5, rolling_friction), GENERATE(rigid_settings(), matched_settings()));
    world.step(200);
    const double speed = world.velocity().x();
    world.step(300);
    const double acceleration = (world.velocity().x() - speed) / (300 * time_step);
    const double expected = 5.0 / 7.0 * standard_gravity * (std::sin(angle) - rolling_friction * std::cos(angle));
    CHECK(acceleration == Approx(expected).margin(solver_limited * standard_gravity));
    CHECK(slip(world).norm() < solver_limited);
}

TEST_CASE("rolling resistance stops a rolling sphere with 5/7 μ_r g and then holds it", "[rolling]")
{
    // 7/5 m dv/dt = −μ_r m g: v = v₀ − 5/7 μ_r g t, at rest after 7 v₀ / (5 μ_r g).
    const double rolling_friction = 0.1;
    const double speed = 0.5;
    World world = sphere_on_plane(resistant(0.5, rolling_friction), rigid_settings(), time_step, Vec3(speed, 0, 0),
        Vec3(0, speed / standard_radius, 0));
    world.step(100);
    const double deceleration = 5.0 / 7.0 * rolling_friction * standard_gravity;
    CHECK(world.velocity().x() == within(solver_limited, speed - deceleration * 100 * time_step));
    CHECK(slip(world).norm() < solver_limited * speed);
    world.step(static_cast<int>(speed / deceleration / time_step));
    CHECK(world.velocity().norm() < solver_limited * speed);
    CHECK(world.angular_velocity().norm() * standard_radius < solver_limited * speed);
}

TEST_CASE("rolling resistance alone slows a spin by 5/2 μ_r g / r per second", "[rolling][spin]")
{
    // Frictionless floor: I dω/dt = −μ_r r m g with I = 2/5 m r². One row, exact in every step; it cannot turn the spin
    // round.
    const double rolling_friction = 0.05;
    const double spin = 100.0;
    World world =
        sphere_on_plane(resistant(0.0, rolling_friction), rigid_settings(), time_step, Vec3::Zero(), Vec3(0, spin, 0));
    const double deceleration = 2.5 * rolling_friction * standard_gravity / standard_radius;
    world.step(100);
    CHECK(world.angular_velocity().y() == within(1e-12, spin - deceleration * 100 * time_step));
    CHECK(world.velocity().norm() < 1e-15);
    world.step(500);
    CHECK(std::abs(world.angular_velocity().y()) < 1e-12 * spin);
}

TEST_CASE("rolling resistance between two spheres has the arm R* = r₁ r₂ / (r₁ + r₂)", "[rolling]")
{
    // A plastic head-on impact without friction presses with λ_n = m_eff V; each spin across the normal loses at most
    // μ_r R* λ_n of angular momentum, here far less than there is: one sweep, round-off.
    const double r1 = 0.004;
    const double r2 = 0.012;
    const double speed = 1.0;
    const double rolling_friction = 0.2;
    World world = make_world(resistant(0.0, rolling_friction), rigid_settings(), 1e-4);
    world.model.gravity = Vec3::Zero();
    const Vec3 spin(0, 0, 1e4);
    world.add_sphere(Vec3(0, 0, 0), Vec3(speed, 0, 0), spin, r1);
    world.add_sphere(Vec3(r1 + r2, 0, 0), Vec3::Zero(), -spin, r2);
    const double effective_mass = 1.0 / (1.0 / world.mass(0) + 1.0 / world.mass(1));
    world.step();

    const double lost = rolling_friction * r1 * r2 / (r1 + r2) * effective_mass * speed;
    for (const int id : {0, 1}) {
        const double inertia = 0.4 * world.mass(id) * world.radius(id) * world.radius(id);
        const double change = inertia * (spin.norm() - world.angular_velocity(id).norm());
        CHECK(change == within(1e-10, lost)); // 1e-10: the difference is small against the spin
    }
}

TEST_CASE("a sphere that spins about its normal stops after 2 r ω/(5 μ_t g)", "[twisting]")
{
    const double spin = 100.0, twisting_friction = 0.1;
    ContactLaw law = resistant(0.5, GENERATE(0.0, 0.1));
    law.twisting_friction = twisting_friction;
    World world = sphere_on_plane(law, GENERATE(rigid_settings(), matched_settings()), time_step, Vec3::Zero(),
        Vec3(0, 0, GENERATE(1.0, -1.0) * spin));
    const double expected = 2.0 * standard_radius * spin / (5.0 * twisting_friction * standard_gravity);
    const int steps = advance_until(
        world, [](const World& w) { return w.angular_velocity().norm() < 1e-9; }, 10000);
    CHECK(steps * time_step == Approx(expected).margin(time_step * 1.01));
    CHECK(world.velocity().norm() < 1e-12);
}

TEST_CASE("without twisting friction a sphere spins on about its normal", "[twisting]")
{
    World world = sphere_on_plane(resistant(0.5, 0.1), rigid_settings(), time_step, Vec3::Zero(), Vec3(0, 0, 100.0));
    world.step(500);
    CHECK(world.angular_velocity().z() == Approx(100.0).epsilon(1e-12));
}

TEST_CASE("two spheres that twist against each other come to turn together, and keep angular momentum", "[twisting]")
{
    ContactLaw law = resistant(0.5, 0.0);
    law.twisting_friction = 0.05;
    World world = make_world(law, GENERATE(rigid_settings(), matched_settings()), time_step);
    world.model.gravity.setZero();
    world.attract({.force = 0.01, .range = 0.01 * standard_radius}); // so that they press on each other
    world.add_sphere(standard_radius * Vec3::UnitX(), Vec3::Zero(), Vec3(50.0, 0, 0));
    world.add_sphere(-standard_radius * Vec3::UnitX(), Vec3::Zero(), Vec3(-10.0, 0, 0));
    world.step(3000);
    CHECK(world.angular_velocity(0).x() == Approx(20.0).epsilon(1e-9));
    CHECK(world.angular_velocity(1).x() == Approx(20.0).epsilon(1e-9));
}

} // namespace talus::test
