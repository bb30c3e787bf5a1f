// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/pyramid.hpp"

#include <algorithm>

namespace talus::test
{
namespace
{

double fastest_sphere(const World& world)
{
    double fastest = 0.0;
    for (const Body& motion : world.state.bodies) fastest = std::max(fastest, motion.velocity.norm());
    return fastest;
}

} // namespace

TEST_CASE("a pyramid carries the forces of its statics", "[statics][friction]")
{
    // Unique, since the bases do not touch. 1e-9: a converged solve (1e-13) of a dozen coupled rows.
    const int n = GENERATE(2, 3);
    World world = pyramid(n, 0.5, 0.5, rigid_settings());
    world.step();
    REQUIRE(world.report.solve.converged);
    const double weight = world.mass() * standard_gravity;
    const double tangent = weight / n * critical_friction_above(n);
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 2 * static_cast<std::size_t>(n));
    for (const auto& contact : forces) {
        CHECK(contact.normal_force == within(1e-9, (contact.with_wall ? 1.0 + 1.0 / n : 1.0 / n) * weight));
        CHECK(contact.tangent_force.norm() == within(1e-9, tangent));
    }
}

TEST_CASE("a pyramid stands just above its critical friction and moves just below", "[statics][friction]")
{
    // One step from nothing. At 0.999 of the critical friction it begins to move with 1.4e-4 to 1.9e-4 g h (found by an
    // independent solve); at 1.001 it stands, to what a solve of residual 1e-13 leaves.
    const int n = GENERATE(2, 3);
    const bool at_floor = GENERATE(false, true);
    const auto first_speed = [&](double share) {
        const double above = at_floor ? ample_friction : share * critical_friction_above(n);
        const double floor = at_floor ? share * critical_friction_at_floor(n) : ample_friction;
        World world = pyramid(n, above, floor, rigid_settings());
        world.step();
        CHECK(world.report.solve.converged);
        return fastest_sphere(world) / (standard_gravity * automatic_step());
    };
    CHECK(first_speed(1.001) < 1e-9);
    const double below = first_speed(0.999);
    CHECK(below > 1.0e-4);
    CHECK(below < 3.0e-4);
}

TEST_CASE("a pyramid at rest needs no more than the least number of sweeps", "[statics][friction][warm_start]")
{
    // Its impulses, tangential ones too, are those of the step before: nothing is left to correct, even at 1e-10.
    const auto solver = GENERATE(rigid_settings(1e-10), matched_settings(1e-10));
    World world = pyramid(3, 0.5, 0.5, solver);
    world.step(1000);
    CHECK(world.report.solve.converged);
    CHECK(world.report.solve.sweeps == solver.min_sweeps);
}

TEST_CASE("with production settings a pyramid's critical friction is right to 1 %", "[statics][friction][production]")
{
    // Tolerance 1e-2 and a handful of sweeps: 1 % above it stands for a second and more, 1 % below the top falls
    // through.
    const int n = GENERATE(2, 3);
    const bool at_floor = GENERATE(false, true);
    const auto stabilisation = GENERATE(Stabilisation::projected, Stabilisation::matched);
    const auto sinking = [&](double share) {
        const double above = at_floor ? ample_friction : share * critical_friction_above(n);
        const double floor = at_floor ? share * critical_friction_at_floor(n) : ample_friction;
        World world = pyramid(n, above, floor, production_settings(stabilisation));
        const double top = world.position(n).z();
        world.step(6000);
        return (top - world.position(n).z()) / (2.0 * standard_radius);
    };
    CHECK(sinking(1.01) < 0.01);
    CHECK(sinking(0.99) > 0.3);
}

} // namespace talus::test
