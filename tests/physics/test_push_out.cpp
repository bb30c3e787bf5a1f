// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr double time_step = 2.5e-4;
constexpr double overlap = 0.3 * 2 * standard_radius;

/// Two spheres at rest without gravity that overlap by 30 % of a diameter.
World overlapping_spheres(const SolverSettings& solver)
{
    World world = make_world({}, solver, time_step);
    world.model.gravity = Vec3::Zero();
    world.add_sphere(Vec3(standard_radius - 0.5 * overlap, 0, 0));
    world.add_sphere(-world.position(0));
    return world;
}

} // namespace

TEST_CASE("two spheres that overlap at rest part with the push-out speed", "[compliance][push_out]")
{
    // In the first step (W + Σ) λ = (4Υ/h) |g|, so they part with (4Υ/h) |g| W/(W + Σ) =
    // 0.404 |g|/h for Υ = 1/9 and Σ = σ W, σ = 0.1. It takes half of the overlap; the next steps take the rest and
    // never pull back.
    World world = overlapping_spheres(matched_settings());
    const auto parting = [&] { return (world.velocity(0) - world.velocity(1)).x(); };

    SECTION("that pushes at once")
    {
        world.step();
        CHECK(parting() == within(1e-12, 4.0 / 9.0 * overlap / time_step / 1.1));
    }
    SECTION("that nothing has pressed")
    {
        // In the first step h p is compression. Later as much is added as they part in a step: that is their speed.
        // (5 m/s if all of the overlap pushed.)
        const double p = automatic_push_out_speed();
        world.model.solver.push_out_speed = p;
        world.step();
        CHECK(parting() == within(1e-12, 4.0 / 9.0 * p / 1.1));
        world.step(2000);
        CHECK(parting() == Approx(p).epsilon(0.01));
        CHECK((world.position(0) - world.position(1)).norm() > 2 * standard_radius);
    }
    CHECK(linear_momentum(world.state).norm() < 1e-15 * world.mass() * parting());
    CHECK((world.position(0) + world.position(1)).norm() < 1e-15);
    CHECK((world.velocity(0) + world.velocity(1)).norm() < 1e-15);
}

TEST_CASE("the rigid law undoes an overlap without any speed", "[push_out]")
{
    // Positions alone are corrected, each pass by 4Υ of what is left: 1 − 4/9 = 5/9 per step.
    World world = overlapping_spheres(rigid_settings());
    world.step(5);
    CHECK(2 * standard_radius - (world.position(0) - world.position(1)).norm() ==
          within(1e-12, std::pow(5.0 / 9.0, 5) * overlap));
    CHECK(world.report.bodies.fastest_speed == 0.0);
}

} // namespace talus::test
