// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/property.hpp"
#include "tests/properties/random_world.hpp"
#include "tests/properties/room.hpp"
#include "tests/properties/solved.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

// P1: no energy from nothing.
//
// Energy is counted with the potential energy at x − h v/2, METHOD, so that free flight keeps it exactly: from one step
// to the next it changes by Σ m (v + v⁰)/2 · (v − v⁰ − h g), the work of contacts alone. Positions do not come into it.

namespace talus::test
{
namespace
{

struct Bodies {
    double kinetic = 0.0;
    double power = 0.0; ///< of gravity and loads
};

Bodies bodies_of(const World& world)
{
    Bodies sum{kinetic_energy(world.state), 0.0};
    for (std::size_t i = 0; i < world.state.count(); ++i)
        sum.power += world.state.mass(i) * world.model.gravity.dot(world.state.motion[i].velocity);
    for (std::size_t k = 0; k < world.model.pistons.size(); ++k) {
        const Piston& piston = world.model.pistons[k];
        const PistonState& own = world.state.pistons[k];
        const Vec3 force = piston.mass * world.model.gravity + piston.load_at(world.state.time) * piston.guide;
        sum.kinetic += kinetic_energy(piston, own);
        sum.power += force.dot(own.velocity);
    }
    return sum;
}

/// What one step, or sub-step, did to the energy.
struct Books {
    double rise = 0.0;  ///< of kinetic, potential and spring energy, less the work of walls [J]
    double scale = 0.0; ///< the largest of these energies [J]
    StepReport report;
};

Books make_counted_part(World& world, int parts)
{
    const double h = world.model.time_step / parts;
    const Bodies before = bodies_of(world);
    Books books;
    books.report = make_part(world, parts);
    const Bodies after = bodies_of(world);
    const double springs_before = books.report.contacts.stored_energy, springs_after = books.report.outcome.stored_energy;
    const double fallen = 0.5 * h * (before.power + after.power), walls = books.report.outcome.wall_work;
    books.rise = after.kinetic - before.kinetic - fallen + springs_after - springs_before - walls;
    double free_fall = 0.0;
    for (std::size_t i = 0; i < world.state.count(); ++i)
        free_fall += 0.5 * world.state.mass(i) * h * h * world.model.gravity.squaredNorm();
    books.scale =
        std::max({before.kinetic, after.kinetic, springs_before, springs_after, std::abs(walls), free_fall, 1e-300});
    return books;
}

struct Demand {
    Wish wish;
    double may_rise = 0.0; ///< by friction, as a share of the largest energy
};

Verdict energy_of_a_step(std::uint64_t seed, const Demand& demand)
{
    RandomWorld own = draw_world(seed, demand.wish);
    World& world = own.world;
    bool room = warm_up(own);
    const int parts = own.parts.back();
    Verdict verdict{.measure = -1.0, .must_solve = must_be_solved(own)};
    for (int part = 0; part < parts; ++part) {
        room = room && has_room(world, world.model.time_step / parts);
        const World before = world;
        const Books books = make_counted_part(world, parts);
        if (!is_finite(world)) return {Verdict::Outcome::fails, "not a number\n" + picture(own)};
        const double sweeps = books.report.solve.sweeps;
        if (room && !is_solved(world, books.report)) {
            std::ostringstream why;
            why << "world " << seed << ", residual " << books.report.solve.residual << " after " << sweeps << " sweeps";
            return {Verdict::Outcome::unsolved, why.str(), 0.0, verdict.must_solve};
        }
        // In worlds without room impulses grow with the sweeps: what comes of it is bounded by what walls put in.
        const double allowed = !room                         ? 1e-6
                               : own.mass_ratio() <= 30.0    ? 1e-10
                                                             : std::max(1e-10, 1e-12 * sweeps);
        const double rise = books.rise / books.scale;
        verdict.measure = std::max(verdict.measure, rise);
        if (rise > demand.may_rise + allowed) {
            std::ostringstream why;
            why << "energy rises by " << rise << " of the largest (" << books.rise << " J of " << books.scale
                << " J), allowed is " << demand.may_rise + allowed << ", sweeps " << sweeps << ", room " << room << '\n';
            RandomWorld shown = own;
            shown.world = before;
            return {Verdict::Outcome::fails, why.str() + picture(shown), rise};
        }
    }
    end_step(world, parts);
    verdict.outcome = room ? Verdict::Outcome::holds : Verdict::Outcome::no_room;
    return verdict;
}

constexpr double friction_may_add = 0.0; ///< METHOD, limits

} // namespace

TEST_CASE("P1 without friction and push-out no step adds energy", "[energy]")
{
    hold("energy", [](std::uint64_t seed) {
        return energy_of_a_step(seed, {{.friction = false, .push_out = false}});
    });
}

TEST_CASE("P1 with push-out no step adds energy but what it says", "[energy]")
{
    hold("energy_push_out", [](std::uint64_t seed) {
        return energy_of_a_step(seed, {{.friction = false, .push_out = true}});
    });
}

TEST_CASE("P1 with friction no step adds more energy than METHOD says", "[energy]")
{
    hold("energy_friction", [](std::uint64_t seed) {
        return energy_of_a_step(seed, {{.friction = true, .push_out = false}, friction_may_add});
    });
}

} // namespace talus::test
