// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include "core/base/region.hpp"

#include <algorithm>
#include <vector>

namespace talus::test
{
namespace
{

constexpr double time_step = 5e-4;
constexpr int steps = 700; ///< 0.35 s: the block falls, collapses and comes to rest
constexpr int along = 3;   ///< spheres along each edge of the block

/// Spheres on a loose lattice with random velocities and spins, above the floor of an open box: no overlap.
World spheres_above_a_box(double friction, double restitution, const SolverSettings& solver, int seed = 7)
{
    ContactLaw law;
    law.friction = friction;
    law.restitution = restitution;
    World world = make_world(law, solver, time_step);
    const double cell = 2.3 * standard_radius;
    const double edge = along * cell;
    world.add_wall(box_panels({Vec3::Zero(), Vec3(edge, edge, 5 * edge)}, {"z+"}));
    Random random(static_cast<std::uint64_t>(seed));
    const auto random_vector = [&](double size) {
        const double x = uniform(random) - 0.5;
        const double y = uniform(random) - 0.5;
        return Vec3(size * Vec3(x, y, uniform(random) - 0.5));
    };
    for (int k = 0; k < along * along * along; ++k) {
        const Vec3 place(k % along + 0.5, k / along % along + 0.5, k / (along * along) + 1.0);
        const double radius = standard_radius * (0.8 + 0.2 * uniform(random));
        const Vec3 spin = random_vector(100.0), velocity = random_vector(1.0);
        world.add_sphere(cell * place + random_vector(0.2 * standard_radius), velocity, spin, radius);
    }
    return world;
}

double mechanical_energy(const World& world)
{
    return kinetic_energy(world.state) + potential_energy(world.state, world.model.gravity);
}

/// What symplectic Euler conserves in flight is H = T − Σ m g·(x − ½ h v). The energy itself rises by m g h V when a
/// sphere turns elastically at speed V, and falls by ½ m g² h² in each step of the flight.
double discrete_energy(const World& world)
{
    return mechanical_energy(world) +
           0.5 * world.model.time_step * world.model.gravity.dot(linear_momentum(world.state));
}

/// What one of these energies, with ½ Σ k g² stored in compliant contacts, did over a run.
struct EnergyRecord {
    double start = 0.0, end = 0.0, highest = 0.0;
    double worst_rise = 0.0; ///< in one step
    double rises = 0.0;      ///< of all steps together
};

template <class Energy> EnergyRecord record_energy(World& world, Energy energy)
{
    EnergyRecord record;
    record.start = record.end = record.highest = energy(world);
    double without_contacts = record.start;
    for (int step = 0; step < steps; ++step) {
        world.step(); // reports what the contacts stored when it began: this completes the state before it
        const double complete = without_contacts + world.report.contacts.stored_energy;
        const double rise = std::max(0.0, complete - record.end);
        record.worst_rise = std::max(record.worst_rise, rise);
        record.rises += rise;
        record.highest = std::max(record.highest, complete);
        record.end = complete;
        without_contacts = energy(world);
    }
    return record;
}

} // namespace

TEST_CASE(
    "without restitution kinetic, potential and stored contact energy together never rise", "[energy][dissipation]")
{
    // A step changes the energy by λᵀG v − ½ |h f + Gᵀλ|² (metric M⁻¹) with u_n λ_n ≤ 0 and friction against the slip:
    // never up. 1e-7: what steps may add whose residual is not zero. What springs hold is reported for the normals of a
    // step, and turning normals change it between steps; without friction no step adds any (tests/properties).
    const bool rigid = GENERATE(true, false);
    World world = spheres_above_a_box(0.5, 0.0, rigid ? rigid_settings(1e-9, 5000) : matched_settings(1e-9, 1000));
    const auto record = record_energy(world, mechanical_energy);
    CHECK(record.worst_rise < (rigid ? 1e-7 : 5e-3) * record.start);
    CHECK(kinetic_energy(world.state) < 1e-3 * record.start); // it did come to rest
}

TEST_CASE("without friction restitution takes what it should, and elastic spheres keep their energy",
    "[energy][dissipation][restitution]")
{
    // A rigid contact changes H by ½ λ_n (u_n⁺ + u_n⁻), which is never above zero: for an impact ½ λ_n (1 − e) u_n⁻ ≤
    // 0. What rises is what `projected` lifts. What is lost beyond (1 − e²) is where contacts bear impacts beside them.
    const double e = GENERATE(0.5, 0.9, 1.0);
    constexpr int blocks = 100;
    int unusual = 0;
    for (int seed = 1; seed <= blocks; ++seed) {
        World world = spheres_above_a_box(0.0, e, rigid_settings(1e-9, 1000), seed);
        const auto record = record_energy(world, discrete_energy);
        const auto stays_below = [&](double rises, double highest, double change) {
            return record.rises < rises * record.start && record.highest < (1 + highest) * record.start &&
                   (e < 1.0 ? record.end < record.start : std::abs(record.end - record.start) < change * record.start);
        };
        CHECK(stays_below(5e-2, 1e-2, 1e-2));
        if (!stays_below(5e-3, 1e-4, 1e-3)) ++unusual;
    }
    CHECK(unusual <= 20);
}

TEST_CASE("friction and restitution together add next to nothing and never exceed the energy at the start",
    "[energy][dissipation][restitution][friction]")
{
    // Where several impacts meet in one step, Newton's law for the normal and Coulomb's for the tangent can add energy
    // (Kane & Levinson 1985): e alone sets the normal impulse, and friction of that size may work along the slip of
    // before, which another impact turned round. It is rare: all rises together stay below 10 % of the energy that is
    // there.
    const double e = GENERATE(0.5, 0.9);
    World world = spheres_above_a_box(0.5, e, GENERATE(rigid_settings(1e-6, 200), matched_settings(1e-6, 200)));
    const auto record = record_energy(world, discrete_energy);
    CHECK(record.highest <= (1 + 1e-12) * record.start); // round-off of the sums
    CHECK(record.rises < 0.1 * record.start);
}

} // namespace talus::test
