// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/draw.hpp"
#include "tests/properties/property.hpp"
#include "tests/properties/random_world.hpp"
#include "tests/properties/room.hpp"
#include "tests/properties/solved.hpp"
#include "tests/properties/transformed.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

// P3: no decision by rounding, and none by the place or the units from which one looks.

namespace talus::test
{
namespace
{

constexpr double perturbation = 1e-13, moved_at_most = 1e-9, equal = 1e-10;

/// The largest difference of velocities, of spheres by id and of pistons, after one has been taken back [m/s].
double difference(const World& a, const World& b, const Transform& back = {})
{
    double largest = 0.0;
    const double speed = back.length / back.time;
    const auto note = [&](const Vec3& one, const Vec3& other) {
        const double size = (one - other).norm();
        largest = size <= largest ? largest : size; // what is not a number is larger
    };
    for (std::size_t i = 0; i < a.state.count(); ++i) {
        const Body &m = a.state.body(i), &n = b.state.body(b.index_of(a.state.id[i]));
        note(m.velocity, back.turn.transpose() * (n.velocity - back.boost) / speed);
        note(m.rim_velocity, back.turn.determinant() * (back.turn.transpose() * n.rim_velocity) / speed);
    }
    for (std::size_t k = 0; k < a.state.pistons.size(); ++k)
        note(a.state.pistons[k].velocity, back.turn.transpose() * (b.state.pistons[k].velocity - back.boost) / speed);
    return largest;
}

/// A world that has come to the step that is looked at.
struct Ready {
    RandomWorld own;
    int parts = 1;
    double h = 0.0;
    bool room = true;
};

Ready ready(std::uint64_t seed, const Wish& wish)
{
    Ready ready{draw_world(seed, wish)};
    ready.room = warm_up(ready.own);
    ready.parts = ready.own.parts.back();
    ready.h = ready.own.world.model.time_step / ready.parts;
    return ready;
}

/// ε of the sweeps says little about velocities where masses differ much; and not all come to 1e-13, but to 1e-12.
double loosened(const RandomWorld& own, const StepReport& report)
{
    if (!report.solve.converged) return 10.0;
    return own.mass_ratio() <= 30.0 ? 1.0 : std::max(1.0, 0.01 * report.solve.sweeps);
}

/// Whether rounding decides if something is an impact, METHOD (4): it approaches as fast as the slowest one, as does
/// exactly what falls from rest for three steps; or it comes to touch when the step ends, as does what comes back from
/// an elastic impact.
bool is_at_threshold(const World& world, double h)
{
    const Model& model = world.model;
    const double slowest = model.solver.restitution_threshold * model.time_step * model.gravity.norm();
    const double largest = largest_velocity(world);
    const auto near = touches(world, h, 0.5 * model.min_diameter);
    return std::ranges::any_of(near, [&](const Touch& touch) {
        Vec3 u = world.state.body(touch.a).velocity - touch.wall_velocity;
        if (!touch.with_wall) u -= world.state.body(touch.b).velocity;
        const double u_n = u.dot(touch.normal);
        const double ahead = u_n + (touch.with_wall ? h * model.gravity.dot(touch.normal) : 0.0);
        return (slowest > 0.0 && std::abs(u_n + slowest) < 1e-12 * largest) ||
               (touch.gap > 0.0 && ahead < 0.0 && std::abs(touch.gap + h * ahead) < 1e-12 * model.min_diameter);
    });
}

Verdict perturbed_a_little(std::uint64_t seed, const Wish& wish)
{
    Ready at = ready(seed, wish);
    if (!at.room) return {Verdict::Outcome::no_room};
    World& world = at.own.world;
    world.model.solver.tolerance = 1e-13;
    if (is_at_threshold(world, at.h)) return {Verdict::Outcome::left_out};
    const double largest = largest_velocity(world);
    const double way =
        std::min(world.model.min_diameter, 100 * at.h * largest); // of positions, which /h are velocities
    const World before = world;
    World other = world;
    Draw draw(~seed);
    for (std::size_t i = 0; i < other.state.count(); ++i) {
        other.state.position[i] += perturbation * way * draw.in_cube();
        other.state.body(i).velocity += perturbation * largest * draw.in_cube();
        if (world.model.physics.spin) other.state.body(i).rim_velocity += perturbation * largest * draw.in_cube();
    }
    const World other_before = other;
    world.report = make_part(world, at.parts);
    other.report = make_part(other, at.parts);
    for (const World* one : {&world, &other})
        if (!is_solved(*one, one->report))
            return {Verdict::Outcome::unsolved, told_unsolved(at.own, one->report), 0.0, must_be_solved(at.own)};
    const double moved = difference(world, other) / largest;
    if (moved <= moved_at_most * loosened(at.own, world.report)) return {Verdict::Outcome::holds, {}, moved};
    std::ostringstream why;
    why << "a perturbation of " << perturbation << " moves velocities by " << moved << " of the largest, sweeps "
        << world.report.solve.sweeps << " and " << other.report.solve.sweeps << '\n';
    at.own.world = before;
    return {Verdict::Outcome::fails,
        why.str() + picture(at.own) + "  and after the perturbation:\n" + contact_table(other_before, at.parts), moved};
}

struct View {
    const char* name;
    Transform transform;
    bool same_order = true; ///< of the sweeps
};

std::vector<View> views_of(const World& world, Draw& draw)
{
    const double d = world.model.min_diameter, h = world.model.time_step;
    std::vector<View> views(6);
    const Vec3 axis = draw.direction();
    views[0] = {"mirrored", {.turn = Eigen::Matrix3d::Identity() - 2 * axis * axis.transpose()}};
    views[1] = {"turned", {.turn = Eigen::AngleAxisd(draw.uniform(0, 6), draw.direction()).toRotationMatrix()}};
    views[2] = {"shifted", {.shift = 50 * d * draw.in_cube()}};
    views[3] = {"in other units", {.length = std::ldexp(1, draw.integer(-12, 12)),
                                      .time = std::ldexp(1, draw.integer(-12, 12)),
                                      .mass = std::ldexp(1, draw.integer(-12, 12))}};
    const bool turns = std::ranges::any_of(world.model.walls, [](const Wall& wall) {
        return std::ranges::any_of(
            wall.motion, [](const MotionPart& part) { return std::holds_alternative<Turning>(part); });
    });
    const Vec3 along = world.model.pistons.empty() ? draw.direction() : world.model.pistons[0].guide;
    if (!turns) views[4] = {"boosted", {.boost = 0.1 * d / h * draw.uniform(-1, 1) * along}};
    if (turns) views.erase(views.begin() + 4);
    views.back() = {"with its ids reversed", {.reversed = true}, false};
    return views;
}

Verdict seen_otherwise(std::uint64_t seed, const Wish& wish)
{
    Ready at = ready(seed, wish);
    if (!at.room) return {Verdict::Outcome::no_room};
    if (is_at_threshold(at.own.world, at.h)) return {Verdict::Outcome::left_out};
    at.own.world.model.solver.tolerance = 1e-13;
    const World before = transformed(at.own.world, {}, at.h);
    World world = before;
    const double largest = largest_velocity(world);
    world.report = make_part(world, at.parts);
    if (!is_solved(world, world.report))
        return {Verdict::Outcome::unsolved, told_unsolved(at.own, world.report), 0.0, must_be_solved(at.own)};
    Draw draw(~seed);
    Verdict verdict;
    std::ostringstream why;
    std::string tables;
    for (const View& view : views_of(world, draw)) {
        World other = transformed(at.own.world, view.transform, at.h * view.transform.time);
        const bool one_tile = before.network.list.tiles.count() <= 1 && other.network.list.tiles.count() <= 1;
        if (!at.own.is_frictionless() && !(view.same_order && one_tile)) continue; // the solution may not be unique
        const World other_before = other;
        other.report = make_part(other, at.parts);
        if (!is_solved(other, other.report)) {
            verdict = {Verdict::Outcome::unsolved, told_unsolved(at.own, other.report), 0.0, must_be_solved(at.own)};
            continue;
        }
        const double apart = difference(world, other, view.transform) / largest;
        verdict.measure = std::max(verdict.measure, apart);
        if (apart <= equal * std::max(loosened(at.own, world.report), loosened(at.own, other.report))) continue;
        why << view.name << ": differs by " << apart << " of the largest velocity, sweeps " << world.report.solve.sweeps
            << " and " << other.report.solve.sweeps << '\n';
        tables += std::string("  contacts when it is ") + view.name + ":\n" + contact_table(other_before, at.parts);
    }
    if (why.str().empty()) return verdict;
    at.own.world = before;
    return {Verdict::Outcome::fails, why.str() + picture(at.own) + tables, verdict.measure};
}

} // namespace

TEST_CASE("P3 a perturbation by rounding moves a step by little more", "[continuity]")
{
    hold("continuity", [](std::uint64_t seed) { return perturbed_a_little(seed, {}); });
    hold("continuity_moduli", [](std::uint64_t seed) { return perturbed_a_little(seed, {.elasticity = true}); });
}

TEST_CASE("P3 a world seen from elsewhere, or in other units, makes the same step", "[invariance]")
{
    hold("invariance", [](std::uint64_t seed) { return seen_otherwise(seed, {}); });
}

} // namespace talus::test
