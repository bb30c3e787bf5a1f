// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/as_a_scene.hpp"
#include "tests/properties/draws.hpp"
#include "tests/properties/event_driven.hpp"
#include "tests/support/median.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// With small steps the program does what one does that goes from impact to impact.

namespace talus::test
{
namespace
{

constexpr double d = 2 * standard_radius;

constexpr double slow = 0.03; ///< of the fastest; slower impacts are left out
constexpr double push = 0.1;  ///< of that: what pushes less only grazes, or rests

/// Of an event-driven run: where it began, its impacts, and where it ended, between two of them.
struct Story {
    Stabilisation law = Stabilisation::matched;
    double step = 0.0; ///< the automatic one [s]
    int steps = 0;     ///< of it
    EventDriven begin, end;
    std::vector<Event> events;
    double shortest = infinity; ///< time between two impacts that share a sphere [s]
};

FreeSphere any_sphere(Draw& draw, double mass_range)
{
    FreeSphere s;
    s.radius = standard_radius * (draw.chance(0.5) ? 1.0 : draw.log_uniform(0.5, 2));
    const double density = standard_density * (draw.chance(0.5) ? 1.0 : draw.log_uniform(1 / mass_range, mass_range));
    s.mass = density * 4.0 / 3.0 * std::numbers::pi * std::pow(s.radius, 3);
    return s;
}

bool is_free(const FreeSphere& s, const EventDriven& world)
{
    return std::ranges::all_of(
               world.faces, [&](const Face& f) { return (s.x - f.point).dot(f.normal) > (1 + 1e-9) * s.radius; }) &&
           std::ranges::all_of(world.spheres,
               [&](const FreeSphere& t) { return (s.x - t.x).norm() > (1 + 1e-9) * (s.radius + t.radius); });
}

/// A few spheres of any sizes and masses: they fly about between planes that stand at any angle, or nearly touch when
/// one of them is shot at the others.
EventDriven any_spheres(Draw& draw)
{
    EventDriven world;
    if (draw.chance(0.5)) world.gravity = -standard_gravity * Vec3::UnitZ();
    const int walls = draw.integer(0, 3), spheres = draw.integer(2, 5);
    // Without restitution what meets a wall stays there, which this program does not know.
    world.restitution = draw.chance(0.3) ? 1.0 : walls == 0 && draw.chance(0.3) ? 0.0 : draw.uniform(0.2, 1);
    const double room = draw.uniform(1.2, 3) * d, mass_range = draw.chance(0.3) ? 1000 : 30;
    const Vec3 middle(0, 0, room);
    if (walls > 0) world.faces.push_back({Vec3::Zero(), Vec3::UnitZ()});
    for (int w = 1; w < walls; ++w) {
        Vec3 n = draw.direction();
        n.z() = 0.3 * std::abs(n.z());
        n.normalize();
        world.faces.push_back({middle - room * n, n});
    }
    const double speed = draw.log_uniform(0.3, 3);
    const bool cluster = draw.chance(0.7);
    for (int tries = 0; tries < 1000 && static_cast<int>(world.spheres.size()) < spheres; ++tries) {
        FreeSphere s = any_sphere(draw, mass_range);
        if (cluster && !world.spheres.empty()) {
            const int neighbour = draw.integer(0, static_cast<int>(world.spheres.size()) - 1);
            const FreeSphere& t = world.spheres[static_cast<std::size_t>(neighbour)];
            s.x = t.x + (t.radius + s.radius + draw.log_uniform(1e-5, 0.3) * d) * draw.direction();
            s.v = t.v + (draw.chance(0.5) ? 0.0 : 0.1 * speed) * draw.direction();
        } else if (cluster && walls > 0) {
            s.x = Vec3(0, 0, s.radius + draw.log_uniform(1e-5, 0.3) * d);
            s.v = -0.1 * speed * Vec3::UnitZ();
        } else {
            s.x = middle + room * draw.in_cube();
            s.v = speed * (draw.direction() - 0.5 * (s.x - middle).normalized());
        }
        if (is_free(s, world)) world.spheres.push_back(s);
    }
    if (cluster && world.spheres.size() > 1) {
        FreeSphere& shot = world.spheres.back();
        shot.v = speed * (0.3 * draw.direction() + (world.spheres.front().x - shot.x).normalized());
    }
    return world;
}

World talus_world(const EventDriven& from, Stabilisation law)
{
    World world = empty_world({.restitution = from.restitution});
    world.model.gravity = from.gravity;
    for (const Face& f : from.faces) world.add_plane(f.point, f.normal);
    for (const FreeSphere& s : from.spheres)
        world.add_sphere(
            s.x, s.v, Vec3::Zero(), s.radius, s.mass / (4.0 / 3.0 * std::numbers::pi * std::pow(s.radius, 3)));
    set_as_a_scene(world, law);
    return world;
}

bool share_a_sphere(const Event& a, const Event& b)
{
    return a.a == b.a || (!b.with_wall && a.a == b.b) || (!a.with_wall && (a.b == b.a || (!b.with_wall && a.b == b.b)));
}

/// A world with some impacts, none of which is slow, or so near to the next that rounding decides which comes first.
Story any_story(Draw& draw)
{
    for (;;) {
        Story story;
        story.law = draw.chance(0.5) ? Stabilisation::matched : Stabilisation::projected;
        story.begin = story.end = any_spheres(draw);
        story.step = talus_world(story.begin, story.law).model.time_step;
        const int wanted = draw.integer(2, 8);
        EventDriven& world = story.end;
        bool good = true;
        while (good && static_cast<int>(story.events.size()) < wanted) {
            const std::vector<Event> next = world.next_two();
            if (!(next[0].time < 600 * story.step)) break;
            good = next[1].time - next[0].time > 1e-9 * story.step;
            world.strike(next[0]);
            double fastest = 0.0;
            for (const FreeSphere& s : world.spheres) fastest = std::max(fastest, s.v.norm());
            good = good && world.last.speed > slow * fastest;
            for (const Event& e : story.events)
                if (share_a_sphere(e, world.last)) story.shortest = std::min(story.shortest, world.time - e.time);
            story.events.push_back(world.last);
        }
        if (!good || story.events.size() < 2) continue;
        // It ends at a whole step in the middle between this impact and the next, some steps from both.
        const double next = std::min(world.next_two()[0].time, world.time + 40 * story.step);
        story.steps = static_cast<int>(std::lround(0.5 * (world.time + next) / story.step));
        const double end = story.steps * story.step;
        if (end < world.time + story.step || end > next - story.step) continue;
        world.fly(end);
        return story;
    }
}

/// What Talus makes of it with this part of the automatic step.
struct Telling {
    double error = 0.0;     ///< of velocities in the end, the largest, of the fastest
    double misplaced = 0.0; ///< of places, the largest, of how far the fastest flies in the time
    bool same = true;       ///< the same impacts in the same order; those of a step have none
    std::string other;      ///< the first that is not
};

Telling tell(const Story& story, int parts)
{
    World world = talus_world(story.begin, story.law);
    world.model.time_step /= parts;
    const double h = world.model.time_step;
    Telling telling;
    double fastest = 0.0;
    for (const FreeSphere& s : story.end.spheres) fastest = std::max(fastest, s.v.norm());
    for (const FreeSphere& s : story.begin.spheres) fastest = std::max(fastest, s.v.norm());
    const auto lighter = [&](const ContactForce& c) {
        return c.with_wall ? world.mass(c.a) : std::min(world.mass(c.a), world.mass(c.b));
    };
    const auto is_impact = [&](const ContactForce& c) {
        return c.normal_force * h > push * slow * fastest * lighter(c);
    };
    std::size_t told_so_far = 0;
    std::vector<Event> before; ///< impacts of the last step
    const int steps = story.steps * parts;
    for (int k = 0; k < steps; ++k) {
        world.step();
        std::vector<Event> here;
        for (const ContactForce& c : world.contact_forces()) {
            if (!is_impact(c)) continue;
            Event event{.time = world.state.time,
                .a = static_cast<int>(c.a),
                .b = static_cast<int>(c.b),
                .with_wall = c.with_wall,
                .speed = c.normal_force * h / lighter(c)};
            if (!c.with_wall && event.a < event.b) std::swap(event.a, event.b);
            here.push_back(event);
        }
        // An impact may take two steps: what it closes in the first it stops in the second.
        std::erase_if(here, [&](const Event& event) {
            return std::ranges::any_of(before, [&](const Event& e) { return e.same_bodies(event); });
        });
        before = here;
        const std::size_t from = std::min(told_so_far, story.events.size());
        const std::size_t to = std::min(from + here.size(), story.events.size());
        for (const Event& event : here)
            if (telling.same && std::none_of(story.events.begin() + static_cast<std::ptrdiff_t>(from),
                                    story.events.begin() + static_cast<std::ptrdiff_t>(to),
                                    [&](const Event& e) { return e.same_bodies(event); })) {
                telling.same = false;
                telling.other = text("where impact %d should be there is at %.4f steps %d with %s%d (push %.3g m/s)",
                    static_cast<int>(from) + 1, event.time / story.step, event.a, event.with_wall ? "wall " : "",
                    event.b, event.speed);
            }
        told_so_far += here.size();
    }
    if (telling.same && told_so_far != story.events.size()) {
        telling.same = false;
        telling.other = text("%d impacts", static_cast<int>(told_so_far));
    }
    for (std::size_t i = 0; i < story.end.spheres.size(); ++i) {
        const auto id = static_cast<std::int64_t>(i);
        telling.error = std::max(telling.error, (world.velocity(id) - story.end.spheres[i].v).norm() / fastest);
        telling.misplaced = std::max(
            telling.misplaced, (world.position(id) - story.end.spheres[i].x).norm() / (fastest * story.end.time));
    }
    return telling;
}

std::string told(const Story& story)
{
    const EventDriven& w = story.begin;
    std::string lines = text("%s, e %.4g, gravity %d, step %.4g s, %d steps of it, %d walls\n  masses and radii:",
        story.law == Stabilisation::matched ? "matched" : "projected", w.restitution, !w.gravity.isZero(), story.step,
        story.steps, static_cast<int>(w.faces.size()));
    for (const FreeSphere& s : w.spheres)
        lines += text(" %.3g %.3g;", s.mass / w.spheres[0].mass, s.radius / standard_radius);
    lines += "\n  impacts, by the step they come in:";
    for (const Event& e : story.events)
        lines += text(
            " %d with %s%d at %.4f with %.3g m/s;", e.a, e.with_wall ? "wall " : "", e.b, e.time / story.step, e.speed);
    return lines;
}

constexpr double near_enough = 0.01;

/// Steps that are short against the time between impacts that share a sphere tell the same story.
Fault small_steps(Draw& draw)
{
    const Story story = any_story(draw);
    Telling last;
    int parts = 4;
    for (;; parts *= 4) {
        last = tell(story, parts);
        if (last.same && last.error < near_enough && last.misplaced < near_enough) return {};
        if (story.step / parts < 0.1 * story.shortest && parts >= 256) break;
        if (parts * story.steps > 400000) break; // too much to ask for: impacts all but at one instant
    }
    if (story.step / parts > 0.1 * story.shortest) return {};
    return told(story) +
           text("\n  with 1/%d of the step: velocities wrong by %.2g, places by %.2g; ", parts, last.error,
               last.misplaced) +
           (last.same ? std::string("the same impacts") : last.other);
}

} // namespace

TEST_CASE("small steps lead to the impacts of an event-driven program", "[events]")
{
    for_all_worlds(1.0 / 8, small_steps);
}

TEST_CASE("errors fall with the step, and more worlds have all impacts in order", "[events][order]")
{
    // Instants are wrong by up to h, by chance, so only the median over worlds shows the order of the method.
    constexpr int worlds = 400, halvings = 3;
    int same[halvings] = {};
    std::vector<double> misplaced[halvings];
    for (int seed = 1; seed <= worlds; ++seed) {
        Draw draw(static_cast<std::uint64_t>(seed));
        const Story story = any_story(draw);
        for (int k = 0; k < halvings; ++k) {
            const Telling telling = tell(story, 1 << k);
            same[k] += telling.same;
            misplaced[k].push_back(telling.misplaced);
        }
    }
    for (int k = 0; k + 1 < halvings; ++k) {
        CAPTURE(k, same[k], same[k + 1], median(misplaced[k]), median(misplaced[k + 1]));
        CHECK(median(misplaced[k + 1]) / median(misplaced[k]) < 0.6);
        CHECK(same[k + 1] >= same[k]);
    }
    CHECK(same[halvings - 1] > 0.85 * worlds);
}

} // namespace talus::test
