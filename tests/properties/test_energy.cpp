// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/property.hpp"
#include "tests/properties/random_world.hpp"
#include "tests/properties/room.hpp"
#include "tests/properties/solved.hpp"
#include "tests/support/contacts.hpp"

#include "core/contacts/assembly.hpp"
#include "core/law/impact.hpp"

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

constexpr double digits_of_kappa =
    1e-6; ///< it is handed on in few of them, and twice of that is in its spring's energy

struct Bodies {
    double kinetic = 0.0;
    double power = 0.0; ///< of gravity and loads
};

Bodies bodies_of(const World& world)
{
    Bodies sum{kinetic_energy(world.state), 0.0};
    for (std::size_t i = 0; i < world.state.count(); ++i)
        sum.power += world.state.mass(i) * world.model.gravity.dot(world.state.body(i).velocity);
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
    double rise = 0.0;   ///< of kinetic, potential and spring energy, less the work of walls [J]
    double change = 0.0; ///< of kinetic and potential energy alone [J]
    double scale = 0.0;  ///< the largest of these energies [J]
    StepReport report;
};

/// What attraction took out of the motion in the step that the world has made, as gravity is counted.
double taken_by_attraction(const World& before, const World& after)
{
    double sum = 0.0;
    const auto mean_velocity = [&](std::int32_t sphere) {
        const std::int64_t id = after.state.id[static_cast<std::size_t>(sphere)];
        return Vec3(0.5 * (before.velocity(id) + after.velocity(id)));
    };
    for_each_contact(after.network, [&](const TileContacts& contacts, std::size_t k, bool with_wall) {
        if (!contacts.attracts(k)) return;
        const Vec3 other = !with_wall                    ? mean_velocity(contacts.b(k))
                           : contacts.has_moving_walls() ? contacts.wall(k).velocity
                                                         : Vec3::Zero().eval();
        sum -= contacts.attraction(k).dot(mean_velocity(contacts.a(k)) - other);
    });
    return sum;
}

Books make_counted_part(World& world, int parts)
{
    const double h = world.model.time_step / parts;
    const Bodies before = bodies_of(world);
    const World at_first = world;
    Books books;
    books.report = make_part(world, parts);
    const Bodies after = bodies_of(world);
    const double springs_before = books.report.contacts.stored_energy,
                 springs_after = books.report.outcome.stored_energy;
    const double fallen = 0.5 * h * (before.power + after.power),
                 walls = books.report.outcome.wall_work + books.report.outcome.wall_gain_work;
    books.change = after.kinetic - before.kinetic - fallen;
    const double attraction = world.model.physics.attraction ? taken_by_attraction(at_first, world) : 0.0;
    books.rise = books.change + springs_after - springs_before - walls + attraction;
    const double still = 1e-9 * world.model.min_diameter / h; // slower than this is at rest
    double least = 0.0;
    for (std::size_t i = 0; i < world.state.count(); ++i)
        least += 0.5 * world.state.mass(i) * (h * h * world.model.gravity.squaredNorm() + still * still);
    for (std::size_t k = 0; k < world.model.pistons.size(); ++k) {
        const Piston& piston = world.model.pistons[k];
        least += 0.5 * piston.mass * piston.free_gain(world.model.gravity, world.state.time, h).squaredNorm();
    }
    for_each_contact(world.network, [&](const TileContacts& contacts, std::size_t k, bool) {
        least += 0.5 * contacts.contact(k).inverse_mass_sum * contacts.attraction(k).squaredNorm();
    });
    books.scale = std::max(
        {before.kinetic, after.kinetic, springs_before, springs_after, std::abs(walls), std::abs(attraction), least});
    return books;
}

/// What pushing out can put in beside the springs: the impulses of rows that push without one, times their speed.
double pushed_by_rows(const World& world, double h)
{
    double sum = 0.0;
    for_each_contact(world.network, [&](const TileContacts& contacts, std::size_t k, bool) {
        const Contact own = contacts.contact(k);
        if (own.kind != ContactKind::resting && own.kind != ContactKind::yielding) return;
        const double speed = std::min(world.model.solver.push_out_speed, 4.0 * upsilon * std::max(0.0, -own.gap) / h);
        sum += std::max(0.0, contacts.impulse(k).dot(contacts.normal(k))) * speed;
    });
    return sum;
}

std::string in_words(const Books& books)
{
    std::ostringstream text;
    text << "energy rises by " << books.rise / books.scale << " of the largest, " << books.scale << " J; "
         << books.change << " in velocities, springs from " << books.report.contacts.stored_energy << " to "
         << books.report.outcome.stored_energy << ", work of walls " << books.report.outcome.wall_work << "; residual "
         << books.report.solve.residual << " after " << books.report.solve.sweeps << " sweeps";
    return text.str();
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
            return {Verdict::Outcome::unsolved, told_unsolved(own, books.report), 0.0, verdict.must_solve};
        }
        // In worlds without room impulses grow with the sweeps, and what walls put in is not known but for its size.
        const double springs = books.report.outcome.stored_energy / books.scale;
        const double by_walls = std::abs(books.report.outcome.wall_work) / books.scale;
        const double allowed = !room                      ? 1e-6 + 2.0 * by_walls
                               : own.mass_ratio() <= 30.0 ? 1e-10
                                                          : std::max(1e-10, 1e-12 * sweeps);
        const double rise = books.rise / books.scale;
        verdict.measure = std::max(verdict.measure, rise);
        const double pushed = world.model.solver.push_out_speed > 0.0
                                  ? pushed_by_rows(world, world.model.time_step / parts) / books.scale
                                  : 0.0;
        if (rise > demand.may_rise + pushed + allowed + digits_of_kappa * springs) {
            std::ostringstream why;
            why << in_words(books) << "; allowed is " << demand.may_rise + pushed + allowed << ", room " << room
                << '\n';
            RandomWorld shown = own;
            shown.world = before;
            return {Verdict::Outcome::fails, why.str() + picture(shown), rise};
        }
    }
    end_step(world, parts);
    verdict.outcome = room ? Verdict::Outcome::holds : Verdict::Outcome::no_room;
    return verdict;
}

constexpr double friction_may_add = 1.0; ///< METHOD, limits

/// The potential energy that positions gained beyond what velocities brought them [J].
double lifted(const World& before, const World& after, double h)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < after.state.count(); ++i) {
        const Vec3 way = after.state.position[i] - before.position(after.state.id[i]);
        sum -= after.state.mass(i) * after.model.gravity.dot(way - h * after.state.body(i).velocity);
    }
    for (std::size_t k = 0; k < after.model.pistons.size(); ++k) {
        const Piston& piston = after.model.pistons[k];
        const Vec3 force = piston.mass * after.model.gravity + piston.load_at(before.state.time) * piston.guide;
        const Vec3 way = after.state.pistons[k].pose(piston.center) - before.state.pistons[k].pose(piston.center);
        sum -= force.dot(way - h * after.state.pistons[k].velocity);
    }
    return sum;
}

/// What positions far from the origin round away of it [J].
double rounded_away(const World& world)
{
    double sum = 0.0;
    const Vec3& gravity = world.model.gravity;
    for (std::size_t i = 0; i < world.state.count(); ++i)
        sum += world.state.mass(i) * gravity.cwiseProduct(world.state.position[i]).norm();
    for (std::size_t k = 0; k < world.model.pistons.size(); ++k) {
        const Piston& piston = world.model.pistons[k];
        sum += piston.mass * gravity.cwiseProduct(world.state.pistons[k].pose(piston.center)).norm();
    }
    return 1e-15 * sum;
}

/// At most what push-out can put into the springs in a step, METHOD (energy): their force, k κ and that of their
/// damping, times its way.
double most_pushed_out(const World& world, const LawOfStep& law)
{
    const double whole = law.parts * law.h, way = law.h * world.model.solver.push_out_speed;
    double sum = 0.0;
    for_each_contact(world.network, [&](const TileContacts& contacts, std::size_t k, bool) {
        const double depth = std::max(0.0, -contacts.gap(k));
        const double stiffness = world.model.materials.laws[0].stiffness; // in these worlds all are equally stiff
        LawOfStep of_whole = law;
        of_whole.h = whole;
        const double W = contacts.contact(k).inverse_mass_sum;
        const double k_n = 4.0 * upsilon / (spring_compliance<double>(stiffness, W, of_whole) * whole * whole);
        const double speed = 2.0 * largest_velocity(world); // before the step and after it
        sum += k_n * std::min(way, depth) * (depth + law.h * speed);
    });
    return sum;
}

/// What a step tells of springs and positions is what the bodies say: the columns of the books.
Verdict books_are_right(std::uint64_t seed, const Wish& wish)
{
    RandomWorld own = draw_world(seed, wish);
    World& world = own.world;
    own.warm_up_tolerance =
        1e-12; // what springs are left with stands in the impulses, and is only as right as they are
    if (!warm_up(own)) return {Verdict::Outcome::no_room};
    const int parts = own.parts.back();
    const double h = world.model.time_step / parts;
    const double left = world.report.outcome.stored_energy; // by the part before
    const World before = world;
    const Books books = make_counted_part(world, parts);
    const ContactSurvey& springs = books.report.contacts;
    std::ostringstream why;
    if (springs.stored_energy - springs.push_out_energy >
        left + digits_of_kappa * std::max(left, springs.stored_energy))
        why << "springs hold " << springs.stored_energy << " J when the step begins, of which pushing out has put in "
            << springs.push_out_energy << " J, but the step before left " << left << " J\n";
    const double most = most_pushed_out(world, law_of_step(world.model, part_of_step(world.model, parts)));
    if (springs.push_out_energy > most * (1.0 + digits_of_kappa) + 1e-300)
        why << "pushing out puts in " << springs.push_out_energy << " J, its bound is " << most << " J\n";
    if (springs.push_out_energy < 0.0 || springs.stored_energy < 0.0 || books.report.outcome.stored_energy < 0.0)
        why << "a spring holds less than nothing\n";
    const double rose = lifted(before, world, h);
    const double digits = 1e-8 * std::max(books.scale, std::abs(rose)) + rounded_away(before);
    if (std::abs(rose - books.report.lifted_energy) > digits)
        why << "positions were lifted by " << rose << " J, told are " << books.report.lifted_energy
            << " J, the scale is " << books.scale << " J\n";
    if (why.str().empty()) return {};
    own.world = before;
    return {Verdict::Outcome::fails, why.str() + picture(own)};
}

/// Walls that close until there is no room, and on: all stays finite, no energy comes but what they put in, and the run
/// is reported.
Verdict pressed(std::uint64_t seed)
{
    RandomWorld own = draw_world(seed, {.push_out = false, .press = true});
    World& world = own.world;
    world.model.solver.max_sweeps = 3000; // there may be no solution
    const double h = world.model.time_step;
    bool told = false, room = true;
    int steps_without = 0;
    double deepest = 0.0;
    for (int step = 0; step < 400 && steps_without < 250; ++step) {
        room = has_room(world, h);
        steps_without += !room;
        const World before = world;
        const Books books = make_counted_part(world, 1);
        const auto fail = [&](const std::string& why) -> Verdict {
            own.world = before;
            return {Verdict::Outcome::fails, "step " + std::to_string(step) + ": " + why + '\n' + picture(own)};
        };
        if (!is_finite(world)) return fail("not a number");
        const double walls = std::abs(books.report.outcome.wall_work);
        if (books.rise > 2.0 * walls + 1e-6 * books.scale && own.is_frictionless()) return fail(in_words(books));
        for (const Incident& incident : books.report.bodies.incidents)
            told = told || incident.kind == Incident::Kind::pressed;
        deepest = std::max(deepest, books.report.contacts.worst_overlap / world.model.min_diameter);
    }
    if (steps_without == 0) return {Verdict::Outcome::left_out};
    if (!told && steps_without > 120 && deepest > 0.3) {
        std::ostringstream why;
        why << "nothing was reported in " << steps_without << " steps without room, overlaps up to " << deepest
            << " d\n";
        return {Verdict::Outcome::fails, why.str() + picture(own)};
    }
    return {Verdict::Outcome::no_room};
}

} // namespace

TEST_CASE("P1 without friction and push-out no step adds energy", "[energy]")
{
    hold("energy", [](std::uint64_t seed) { return energy_of_a_step(seed, {{.friction = false, .push_out = false}}); });
}

TEST_CASE("P1 with attraction no step adds energy but what that gives", "[energy]")
{
    hold("energy_attraction", [](std::uint64_t seed) {
        return energy_of_a_step(seed, {{.friction = false, .push_out = false, .pistons = false, .attraction = true}});
    });
}

TEST_CASE("P1 where materials have moduli no step adds energy", "[energy]")
{
    hold("energy_moduli", [](std::uint64_t seed) {
        return energy_of_a_step(seed, {{.friction = false, .push_out = false, .elasticity = true}});
    });
}

TEST_CASE("P1 the books say what springs hold, what pushing out puts in, and what positions are lifted by", "[energy]")
{
    hold("books", [](std::uint64_t seed) { return books_are_right(seed, {}); });
    hold("books_moduli", [](std::uint64_t seed) { return books_are_right(seed, {.elasticity = true}); });
}

TEST_CASE("P1 where walls leave no room all stays finite, energy is what they put in, and it is reported",
    "[press][!mayfail]")
{
    hold("press", pressed, 0.1); // some hundred steps each
}

TEST_CASE("P1 with push-out no step adds energy but what it says", "[energy]")
{
    hold("energy_push_out",
        [](std::uint64_t seed) { return energy_of_a_step(seed, {{.friction = false, .push_out = true}}); });
}

TEST_CASE("P1 with friction no step adds more energy than METHOD says", "[energy]")
{
    hold("energy_friction", [](std::uint64_t seed) {
        return energy_of_a_step(seed, {{.friction = true, .push_out = false}, friction_may_add});
    });
}

} // namespace talus::test
