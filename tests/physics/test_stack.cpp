// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <algorithm>

namespace talus::test
{
namespace
{

constexpr int height = 10; ///< spheres
constexpr double time_step = 2.5e-4;

/// Spheres 0 … n−1 one on the other, exactly upright, touching without overlap.
World column(const ContactLaw& law, const SolverSettings& solver, int n = height)
{
    World world = make_world(law, solver, time_step);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < n; ++k) world.add_sphere((2 * k + 1) * standard_radius * Vec3::UnitZ());
    return world;
}

ContactLaw rough()
{
    ContactLaw law;
    law.friction = 0.5;
    return law;
}

/// How many spheres a contact carries: all from its upper one up.
double carried_spheres(const ContactForce& contact, int n = height)
{
    return static_cast<double>(n - (contact.with_wall ? contact.a : std::max(contact.a, contact.b)));
}

} // namespace

TEST_CASE("contact k of a column of n spheres carries the weight of n − k + 1", "[statics]")
{
    // One step from nothing: the solver alone must bring the load through the column. Its error is the last change of a
    // sweep times 1/(1 − ρ) = 45, ρ = cos²(π/21) for 10 spheres: 1e-11 of the residual's 1e-13.
    World world = column(rough(), rigid_settings());
    world.step();
    REQUIRE(world.report.solve.converged);
    const double weight = world.mass() * standard_gravity;
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == height);
    for (const auto& contact : forces) {
        CHECK(contact.normal_force == within(1e-10, carried_spheres(contact) * weight));
        CHECK(contact.tangent_force.norm() < 1e-10 * weight);
    }
    CHECK(world.report.outcome.from_walls.impulse.z() == within(1e-10, height * weight * time_step));
}

TEST_CASE("a column of soft spheres overlaps by the load over the stiffness in every contact", "[statics][compliance]")
{
    // At rest `matched` gives λ_n/h = k |g|: contact k overlaps by (n − k + 1) m g / k. Tolerance: what is left of the
    // sinking after 1.5 s: damping τ = 2h takes ½ ω² τ = 21/s from the column's slowest wave.
    ContactLaw law = rough();
    law.stiffness = 5000.0;
    World world = column(law, matched_settings(1e-10));
    world.step(6000);
    const double weight = world.mass() * standard_gravity;
    for (const auto& contact : world.contact_forces()) {
        const double load = carried_spheres(contact) * weight;
        CHECK(contact.normal_force == within(1e-8, load));
        CHECK(-contact.gap == within(1e-8, load / law.stiffness));
    }
}

TEST_CASE("production settings bring a column to rest and keep it there", "[statics][production]")
{
    // From nothing at tolerance 1e-2: after a second the floor carries the weight to the solver's tolerance, and
    // nothing creeps (1e-3 d at most, here over 20 000 steps; kinetic energy below 1e-10 m g d).
    World world = column(rough(), production_settings(GENERATE(Stabilisation::projected, Stabilisation::matched)));
    world.step(4000);
    const double weight = world.mass() * standard_gravity;
    for (const auto& contact : world.contact_forces())
        CHECK(contact.normal_force == within(world.model.solver.tolerance, carried_spheres(contact) * weight));

    const double top = world.position(height - 1).z();
    world.step(20000);
    CHECK(world.position(height - 1).z() == Approx(top).margin(1e-3 * 2 * standard_radius));
    CHECK(kinetic_energy(world.state) < 1e-10 * height * weight * 2 * standard_radius);
}

TEST_CASE("a heavy sphere on a light one loads the floor with the weight of both", "[statics]")
{
    // The light one between two heavy things is the hard case of sweeps: they need M/m ln(1/ε).
    const double ratio = GENERATE(10.0, 1000.0);
    World world = make_world(rough(), rigid_settings(1e-13, 100000), time_step);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(standard_radius * Vec3::UnitZ());
    world.add_sphere(
        3 * standard_radius * Vec3::UnitZ(), Vec3::Zero(), Vec3::Zero(), standard_radius, ratio * standard_density);
    world.step();
    REQUIRE(world.report.solve.converged);
    const double weight = world.mass(0) * standard_gravity;
    const double solver_limited = 1e-12 * ratio; // the last change of a sweep times 1/(1 − ρ) = 1 + M/m
    for (const auto& contact : world.contact_forces())
        CHECK(contact.normal_force == within(solver_limited, (contact.with_wall ? 1.0 + ratio : ratio) * weight));
}

} // namespace talus::test
