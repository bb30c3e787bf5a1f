// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double time_step = 2.5e-4;

ContactLaw soft(double stiffness)
{
    ContactLaw law;
    law.stiffness = stiffness;
    return law;
}

double sphere_mass()
{
    return standard_density * 4.0 / 3.0 * std::numbers::pi * std::pow(standard_radius, 3);
}

/// Stiffness [N/m] that makes ω h this number, ω = √(k/m).
double stiffness_for(double omega_h)
{
    return sphere_mass() * omega_h * omega_h / (time_step * time_step);
}

/// A sphere on a floor of this stiffness without gravity, that reaches it at speed V with this gap left. What a load
/// presses is given back at any speed, whatever that with which other overlap is undone.
World soft_impact(double omega_h, double speed, double gap)
{
    World world = sphere_on_plane(soft(stiffness_for(omega_h)), matched_settings(), time_step, Vec3(0, 0, -speed));
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = 0.1 * automatic_push_out_speed();
    world.state.position[0].z() += gap;
    return world;
}

bool has_rebounded(const World& world)
{
    return world.position().z() > standard_radius && world.velocity().z() > 0;
}

} // namespace

TEST_CASE("a sphere at rest on a soft floor overlaps by m g / k", "[statics][compliance]")
{
    // Σ = 4Υ/(k h²) and q = −(4/h)Υ g make λ/h = k |g| at rest, whatever the step: 1e-9 is what the damped sinking
    // leaves.
    const double omega_h = GENERATE(0.05, 0.3, 1.0, 2.0);
    World world = sphere_on_plane(soft(stiffness_for(omega_h)), matched_settings(), time_step);
    world.step(20000);
    const double overlap = world.mass() * standard_gravity / stiffness_for(omega_h);
    CHECK(standard_radius - world.position().z() == Approx(overlap).margin(1e-9 * overlap + 1e-17));
    CHECK(
        world.report.contacts.worst_overlap == Approx(overlap).margin(1e-9 * overlap + 1e-17)); // 1e-17: round-off of z
    CHECK(world.report.contacts.stored_energy == within(1e-8, 0.5 * stiffness_for(omega_h) * overlap * overlap));
}

TEST_CASE("no contact of the matched law is stiffer than its sweeps can carry", "[statics][compliance]")
{
    // k ≤ 2.2 N_min/(W h²), exactly 4Υ/(σ W h²) with σ = 0.2/N_min: a harder material makes no difference.
    const int sweeps = GENERATE(2, 4);
    const double stiffness = GENERATE(as<double>{}, infinity, 1e9);
    auto solver = matched_settings();
    solver.min_sweeps = sweeps;
    World world = sphere_on_plane(soft(stiffness), solver, time_step);
    world.step(1000);
    const double hardest = 4.0 / 9.0 * sweeps / 0.2 * world.mass() / (time_step * time_step);
    const double overlap = world.mass() * standard_gravity / hardest;
    CHECK(standard_radius - world.position().z() == Approx(overlap).margin(1e-9 * overlap + 1e-17));
}

TEST_CASE("a resolved impact on a soft contact rebounds as its step size damps it", "[compliance][restitution]")
{
    // One sphere on a spring k with τ = 2h has e_eff ≈ 1 − π ω h. The table was computed apart, to 1e-3, from
    // first touch at gap 0: largest overlap in V/ω, and how long the contact pushes in 1/ω, which comes in whole steps
    // of ω h.
    const auto [omega_h, rebound, depth, duration] =
        GENERATE(table<double, double, double, double>({{.5, .284, .554, 3.00}, {.2, .560, .753, 3.00},
            {.1, .739, .861, 3.00}, {.05, .857, .926, 3.05}, {.02, .940, .969, 3.12}, {.01, .969, .984, 3.13}}));
    const double speed = 0.1;
    World world = soft_impact(omega_h, speed, 0.0);
    double deepest = 0.0;
    int pushing = 0; // steps in which the contact has an impulse
    while (!has_rebounded(world)) {
        world.step();
        REQUIRE(world.state.steps < 1000);
        deepest = std::max(deepest, standard_radius - world.position().z());
        pushing += world.report.outcome.from_walls.impulse.z() > 0;
    }
    CHECK(world.velocity().z() / speed == Approx(rebound).margin(1e-3));
    CHECK(deepest * omega_h / (speed * time_step) == Approx(depth).margin(1e-3));
    CHECK(pushing * omega_h == Approx(duration).margin(0.5 * omega_h));
}

TEST_CASE("an open gap is closed to the point, so a soft impact starts with what the last step's gap leaves",
    "[compliance][restitution]")
{
    // In the step that would pass through the surface u_n = −g/h holds instead: of V only g/h is left, and the impact
    // that follows is that of the table above at this speed (everything is linear). Without restitution asked for, an
    // impact loses at least what a soft one would; it asks for e to be elastic.
    const double omega_h = 0.1;
    const double speed = 0.1;
    const double share = GENERATE(0.25, 0.9);
    World world = soft_impact(omega_h, speed, share * speed * time_step);
    world.step();
    CHECK(world.velocity().z() == within(1e-10, -share * speed)); // 1e-10: round-off of a gap that is 1e-3 r
    advance_until(world, has_rebounded, 200);
    CHECK(world.velocity().z() == Approx(.739 * share * speed).margin(1e-3 * speed));
}

} // namespace talus::test
