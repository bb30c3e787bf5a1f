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

/// A sphere on a floor of this stiffness without gravity, that reaches it at speed V with this gap left.
World soft_impact(double omega_h, double speed, double gap)
{
    World world = sphere_on_plane(soft(stiffness_for(omega_h)), matched_settings(), time_step, Vec3(0, 0, -speed));
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = 0.1 * automatic_push_out_speed();
    world.state.position[0].z() += gap;
    return world;
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

TEST_CASE("an impact without restitution gives nothing back, however soft the contact", "[compliance][restitution]")
{
    // It is rigid, and stops the sphere; the weight then sinks in.
    const double omega_h = GENERATE(.5, .1, .01), share = GENERATE(0.0, 0.25, 0.9);
    const double speed = 0.1;
    World world = soft_impact(omega_h, speed, share * speed * time_step);
    world.step();
    CHECK(std::abs(world.velocity().z()) < 1e-12 * speed);
    double fastest = 0.0;
    for (int k = 0; k < 500; ++k) {
        world.step();
        fastest = std::max(fastest, world.velocity().z());
    }
    CHECK(fastest < 0.01 * speed);
}

} // namespace talus::test
