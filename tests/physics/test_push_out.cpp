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
    // Deep contacts push like a spring that all of their overlap has pressed, (4Υ/h) |g|, but part with p at most.
    World world = overlapping_spheres(matched_settings());
    const auto parting = [&] { return (world.velocity(0) - world.velocity(1)).x(); };

    SECTION("that pushes at once")
    {
        world.step();
        const double stiffer = std::pow(0.25 / 0.2, 2), softness = 0.1 / stiffer; // Σ/W at 0.3 d
        CHECK(parting() == within(1e-12, 4.0 / 9.0 * overlap / time_step / (1.0 + softness)));
    }
    SECTION("that nothing has pressed")
    {
        // 5 m/s if all of the overlap pushed.
        const double p = automatic_push_out_speed();
        world.model.solver.push_out_speed = p;
        world.step();
        CHECK(parting() == within(1e-12, p));
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
