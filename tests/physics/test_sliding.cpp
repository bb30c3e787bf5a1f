// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr double friction = 0.3;
constexpr double time_step = 1e-3;

ContactLaw rough()
{
    ContactLaw law;
    law.friction = friction;
    return law;
}

/// A sphere on the floor with speed v₀ along x and top spin ω₀ about y.
World moving_sphere(double speed, double spin, const SolverSettings& solver)
{
    return sphere_on_plane(rough(), solver, time_step, Vec3(speed, 0, 0), Vec3(0, spin, 0));
}

bool rolls(const World& world)
{
    return slip(world).norm() < 1e-9;
}

/// A law of friction needs the whole weight, which `matched` carries only once the sphere has sunk into its overlap.
double settling_time(const SolverSettings& solver)
{
    return solver.stabilisation == Stabilisation::matched ? 2 * time_step : time_step;
}

} // namespace

TEST_CASE("a sliding sphere ends rolling at 5/7 of its initial speed", "[friction]")
{
    // Angular momentum about the contact line is kept step by step: v + 2/5 r ω = v₀, and r ω = v at the end. That
    // holds for every step size and whatever the normal force, hence under both laws and to round-off (of 200 steps).
    const double speed = 2.0;
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    World world = moving_sphere(speed, 0.0, solver);
    const double energy = kinetic_energy(world.state);
    const int steps = advance_until(world, rolls, 1000);

    // The slip v − r ω decreases by 7/2 μ g per second: t* = 2 v₀ / (7 μ g) = 0.19417 s, seen at the end of its step.
    const double duration = 2.0 * speed / (7.0 * friction * standard_gravity);
    CHECK(steps * time_step == Approx(duration).margin(settling_time(solver)));
    // Until then v falls evenly: s = 6/7 v₀ t* = 12 v₀² / (49 μ g) = 0.33287 m, to one step at full speed.
    CHECK(world.position().x() == Approx(6.0 / 7.0 * speed * duration).margin(speed * settling_time(solver)));

    world.step(200);
    CHECK(world.velocity().x() == within(1e-12, 5.0 / 7.0 * speed));
    CHECK(world.angular_velocity().y() == within(1e-12, 5.0 / 7.0 * speed / standard_radius));
    // ½ m v² (1 + 2/5) at 5/7 v₀: 2/7 of the energy is gone.
    CHECK(energy - kinetic_energy(world.state) == within(1e-10, 2.0 / 7.0 * energy));
}

TEST_CASE("a spinning sphere on a floor ends rolling at (5 v₀ + 2 r ω₀)/7", "[friction][spin]")
{
    // The same kept sum with spin: v + 2/5 r ω = v₀ + 2/5 r ω₀ = 7/5 v. Slip |v₀ − r ω₀| decreases by 7/2 μ g per
    // second.
    const auto [speed, spin] =
        GENERATE(table<double, double>({{0.0, 200.0}, {1.0, -300.0}, {1.0, 500.0}, {-1.5, 100.0}}));
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    World world = moving_sphere(speed, spin, solver);
    const double expected = (5.0 * speed + 2.0 * standard_radius * spin) / 7.0;
    const double duration = 2.0 * std::abs(speed - standard_radius * spin) / (7.0 * friction * standard_gravity);

    const int steps = advance_until(world, rolls, 2000);
    CHECK(steps * time_step == Approx(duration).margin(settling_time(solver)));
    CHECK(world.velocity().x() == Approx(expected).margin(1e-12)); // round-off of some 200 steps at 1 m/s
    CHECK(world.velocity().y() == 0.0);
}

TEST_CASE("friction acts against the slip, in every direction of the floor alike", "[friction][invariance]")
{
    // The tangential impulse lives on a disk: the path stays on the line of v₀, at right angles not a trace.
    const double angle = GENERATE(0.3, 1.1, 2.9, 4.4);
    const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
    World world = sphere_on_plane(rough(), rigid_settings(), time_step, 2.0 * direction);
    world.step(100);
    const double expected = 2.0 - friction * standard_gravity * 100 * time_step;
    CHECK((world.velocity() - expected * direction).norm() < 1e-12);
}

TEST_CASE("a sliding sphere does not lift off", "[friction]")
{
    // Projection on the disk is Coulomb's law itself; the convex relaxation of it would lift by μ |u_t| h per step.
    World world = moving_sphere(2.0, 0.0, rigid_settings());
    world.step(100);
    CHECK(world.position().z() == within(1e-12, standard_radius));
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    const double weight = world.mass() * standard_gravity;
    CHECK(forces[0].normal_force == within(1e-12, weight));
    CHECK(forces[0].tangent_force.norm() == within(1e-12, friction * weight));
}

TEST_CASE("without friction a sphere slides for ever and its spin does not matter", "[friction][spin]")
{
    // physics.friction is off: no tangential row exists, so velocity along the floor and spin keep their bits.
    World world =
        sphere_on_plane({}, GENERATE(rigid_settings(), matched_settings()), time_step, Vec3(2, 1, 0), Vec3(3, 70, -5));
    const Vec3 spin = world.angular_velocity();
    world.step(500);
    CHECK(world.velocity().x() == 2.0);
    CHECK(world.velocity().y() == 1.0);
    CHECK(world.angular_velocity() == spin);
}

} // namespace talus::test
