// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/draw.hpp"
#include "tests/properties/property.hpp"
#include "tests/properties/random_world.hpp"
#include "tests/properties/room.hpp"
#include "tests/properties/solved.hpp"
#include "tests/support/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>

// P2: what is far away changes nothing.

namespace talus::test
{
namespace
{

/// Puts something where nothing of the world can reach it.
class FarObject
{
public:
    FarObject(const World& world, Draw& draw) : world_(world), draw_(draw)
    {
        for (const Vec3& x : world.state.position) around_.extend(x);
        distance_ = world.model.max_diameter * std::pow(10.0, draw.uniform(1.7, 4.0));
        time_ = 25 * world.model.time_step;
    }

    /// What it is, in words.
    std::string add_to(World& to)
    {
        const Model held = to.model;
        const std::string what = draw_.chance(0.4) ? add_spheres(to) : add_wall(to);
        // These are of the scene, and hold.
        to.model.mean_diameter = held.mean_diameter;
        to.model.min_diameter = held.min_diameter;
        to.model.max_diameter = held.max_diameter;
        to.model.contents = held.contents;
        return what;
    }

private:
    const World& world_;
    Draw& draw_;
    Box around_;
    double distance_, time_;

    double fast() const { return 0.1 * world_.model.min_diameter / world_.model.time_step; }

    /// A place that no wall comes near to.
    std::optional<Vec3> free_place()
    {
        for (int attempt = 0; attempt < 200; ++attempt) {
            const Vec3 x = around_.center() + distance_ * draw_.direction();
            bool free = true;
            for (const PlacedWall& wall : place_walls(world_.model, world_.state, world_.model.time_step)) {
                double gap = infinity;
                for (std::size_t patch = 0; patch < wall.patch_count(); ++patch)
                    gap = std::min(gap, wall.nearest_point(patch, x).distance);
                const double way = wall.moves() ? 3 * time_ * wall.fastest(Box{x, x}) : 0.0;
                free = free && gap > 0.2 * distance_ + way;
            }
            if (free) return x;
        }
        return {};
    }

    std::string add_spheres(World& to)
    {
        const auto place = free_place();
        if (!place) return add_wall(to);
        const double r = draw_.chance(0.5) ? 0.5 * world_.model.min_diameter : 0.5 * world_.model.max_diameter;
        const double volume = 4.0 / 3.0 * std::numbers::pi * r * r * r, mass = world_.state.mass(0);
        const double speed = draw_.one_of({0.0, 0.01, 1.0, 1.9}) * fast(); // faster ones split the step
        const Vec3 velocity = speed * draw_.direction();
        to.add_sphere(*place, velocity, Vec3::Zero(), r, mass / volume);
        if (draw_.chance(0.6)) return speed == 0.0 ? "a sphere at rest" : "a sphere that moves";
        const double apart = 2 * r + draw_.one_of({0.0, -0.01 * r, 0.01 * r, 0.1 * r});
        const double heavy = draw_.one_of({1.0, 10.0, 1000.0});
        to.add_sphere(*place + apart * Vec3::UnitX(), -fast() * Vec3::UnitX(), Vec3::Zero(), r, heavy * mass / volume);
        return "two spheres that meet";
    }

    std::string add_wall(World& to)
    {
        const Vec3 normal = draw_.direction();
        const Vec3 place = around_.center() - distance_ * normal;
        const double size = world_.model.max_diameter * draw_.uniform(1, 10);
        const Vec3 a = size * any_perpendicular(normal), b = a.cross(normal);
        const double speed = fast() * std::pow(10.0, -draw_.uniform(0, 3));
        WallMotion motion;
        std::string how = " that stands still";
        switch (draw_.integer(0, 4)) {
        case 0:
            break;
        case 1:
            motion = {Translation{{}, speed * draw_.direction()}};
            how = " that moves";
            break;
        case 2:
            motion = {Shaking{{}, 0.1 * world_.model.min_diameter * draw_.direction(), 1 / time_}};
            how = " that shakes";
            break;
        case 3:
            motion = {Turning{{}, place, draw_.direction(), speed / size}};
            how = " that turns";
            break;
        default: {
            const double load = draw_.one_of({0.0, standard_gravity}) * world_.state.mass(0);
            to.add_piston(Disk{place, normal, size, 0.0}, world_.state.mass(0) * draw_.log_uniform(0.1, 100), normal,
                {{0.0, load}});
            return "a piston";
        }
        }
        switch (draw_.integer(0, 3)) {
        case 0:
            to.add_wall(Plane{place, normal}, how == " that turns" ? WallMotion{} : motion);
            return "a plane" + how;
        case 1:
            to.add_wall(Panels{{{place - 0.5 * a - 0.5 * b, a, b}}}, motion);
            return "a panel" + how;
        case 2:
            to.add_wall(make_mesh({place - a, place + a, place + b, place - b}, {{{0, 1, 2}}, {{0, 3, 1}}}), motion);
            return "a mesh" + how;
        default:
            to.add_wall(Disk{place, normal, size, 0.0}, motion);
            return "a plate" + how;
        }
    }
};

/// The first difference of what the two have in common; empty if there is none.
std::string difference_in_bits(const World& world, const World& with)
{
    for (std::size_t i = 0; i < world.state.count(); ++i) {
        const std::int64_t id = world.state.id[i];
        const std::size_t j = with.index_of(id);
        const Body &m = world.state.body(i), &n = with.state.body(j);
        std::ostringstream text;
        text << "sphere " << id << ": velocity by " << (m.velocity - n.velocity).norm() << " m/s, rim by "
             << (m.rim_velocity - n.rim_velocity).norm() << " m/s, place by "
             << (world.state.position[i] - with.state.position[j]).norm() << " m";
        if (m.velocity != n.velocity || m.rim_velocity != n.rim_velocity ||
            world.state.position[i] != with.state.position[j])
            return text.str();
    }
    for (std::size_t k = 0; k < world.state.pistons.size(); ++k)
        if (world.state.pistons[k].velocity != with.state.pistons[k].velocity) return "a piston";
    return {};
}

double difference(const World& world, const World& with)
{
    double largest = 0.0;
    const auto note = [&](const Vec3& one, const Vec3& other) {
        const double size = (one - other).norm();
        largest = size <= largest ? largest : size;
    };
    for (std::size_t i = 0; i < world.state.count(); ++i) {
        const Body &m = world.state.body(i), &n = with.state.body(with.index_of(world.state.id[i]));
        note(m.velocity, n.velocity);
        note(m.rim_velocity, n.rim_velocity);
    }
    for (std::size_t k = 0; k < world.state.pistons.size(); ++k)
        note(world.state.pistons[k].velocity, with.state.pistons[k].velocity);
    return largest;
}

Verdict unmoved_by_what_is_far(std::uint64_t seed)
{
    RandomWorld own = draw_world(seed), with = draw_world(seed);
    Draw draw(~seed);
    const std::string what = FarObject(own.world, draw).add_to(with.world);
    const int sweeps = draw.integer(3, 60);
    const SolverSettings exact = own.world.model.solver;
    for (World* world : {&own.world, &with.world}) {
        world->model.solver.tolerance = -1.0; // never reached
        world->model.solver.max_sweeps = sweeps;
    }
    // All steps; the world without the object is kept as it was before the last.
    World before;
    for (std::size_t step = 0; step < own.parts.size(); ++step) {
        const int parts = own.parts[step];
        for (int part = 0; part < parts; ++part) {
            before = own.world;
            const World with_before = with.world;
            own.world.report = make_part(own.world, parts);
            with.world.report = make_part(with.world, parts);
            const std::string differs = difference_in_bits(own.world, with.world);
            if (differs.empty()) continue;
            std::ostringstream why;
            why << "with " << what << " far away, in step " << step << " of " << own.parts.size() << ", part " << part
                << ", " << sweeps << " sweeps: " << differs << '\n';
            own.world = before;
            own.parts.resize(step + 1);
            return {Verdict::Outcome::fails,
                why.str() + picture(own) + "  and with it:\n" + contact_table(with_before, parts)};
        }
        end_step(own.world, parts);
        end_step(with.world, parts);
    }
    // One step more, by the stopping rule.
    if (!has_room(own.world, own.world.model.time_step)) return {Verdict::Outcome::no_room};
    for (World* world : {&own.world, &with.world}) world->model.solver = exact;
    const double largest = largest_velocity(own.world);
    before = own.world;
    const World with_before = with.world;
    own.world.report = make_part(own.world, 1);
    with.world.report = make_part(with.world, 1);
    for (const World* world : {&own.world, &with.world})
        if (!is_solved(*world, world->report))
            return {Verdict::Outcome::unsolved, told_unsolved(own, world->report), 0.0, must_be_solved(own)};
    const double differs = difference(own.world, with.world) / largest;
    const double allowed = std::max(1e-9, 1e-11 * own.world.report.solve.sweeps);
    if (differs <= allowed) return {Verdict::Outcome::holds, {}, differs};
    std::ostringstream why;
    why << "with " << what << " far away, by the stopping rule: velocities differ by " << differs
        << " of the largest\n";
    own.world = before;
    own.parts.push_back(1);
    return {Verdict::Outcome::fails, why.str() + picture(own) + "  and with it:\n" + contact_table(with_before, 1),
        differs};
}

/// What a step makes of a contact.
struct Law {
    ContactKind kind;
    double gap, compression, target, compliance;
};

/// By sphere, other body, and which of its places.
struct Laws : std::map<std::tuple<std::int64_t, std::int64_t, bool, int>, Law> {
    std::set<std::int64_t> met; ///< spheres that come to an impact only within the step
};

Laws laws_of(World world, int parts)
{
    prepare_step(world.state, world.network, world.model, part_of_step(world.model, parts));
    Laws laws;
    for_each_contact(world.network, [&](const TileContacts& contacts, std::size_t k, bool with_wall) {
        const Contact c = contacts.contact(k);
        const std::int64_t a = world.state.id[static_cast<std::size_t>(c.a)];
        const std::int64_t b = with_wall ? c.b : world.state.id[static_cast<std::size_t>(c.b)];
        int place = 0;
        while (laws.contains({a, b, with_wall, place})) ++place;
        if (c.kind == ContactKind::impact && c.gap > 0.0) {
            laws.met.insert(a);
            if (!with_wall) laws.met.insert(b);
        }
        laws[{a, b, with_wall, place}] = {c.kind, c.gap, c.compression, c.target, c.compliance};
    });
    return laws;
}

/// Contacts that overlap: those that are open come to a blow in one sub-step or in another.
Verdict ruled_alike_in_parts(std::uint64_t seed)
{
    RandomWorld own = draw_world(seed);
    if (!warm_up(own)) return {Verdict::Outcome::no_room};
    const World& world = own.world;
    const double d = world.model.min_diameter, h = world.model.time_step, p = world.model.solver.push_out_speed;
    const double largest = largest_velocity(world);
    const int parts = Draw(~seed).integer(2, 10);
    const Laws whole = laws_of(world, 1), split = laws_of(world, parts);
    std::ostringstream why;
    const auto name = [](const auto& key) {
        return "contact of " + std::to_string(std::get<0>(key)) + (std::get<2>(key) ? " at wall " : " on ") +
               std::to_string(std::get<1>(key));
    };
    constexpr double clearly = 1e-8; // overlaps, diameters
    // In a part they may not stand beside an impact yet.
    const auto is_bystander = [&](const auto& key) {
        return whole.met.contains(std::get<0>(key)) || (!std::get<2>(key) && whole.met.contains(std::get<1>(key)));
    };
    const double fastest = 2.0 * largest;
    // By which the target of a blow changes where it is seen from another instant of the step.
    const double turn = 8.0 * h / d * largest * largest;
    for (const auto& [key, law] : whole) {
        if (law.gap > -clearly * d || is_bystander(key)) continue;
        const auto found = split.find(key);
        if (found == split.end()) {
            why << name(key) << " is none in parts\n";
            continue;
        }
        const Law& other = found->second;
        if (law.kind != other.kind) why << name(key) << " is of another kind in parts\n";
        const double kappa = std::max(0.0, law.compression), other_kappa = std::max(0.0, other.compression);
        if (std::abs(kappa - other_kappa) > 1.000001 * p * h + 1e-6 * kappa + h * fastest)
            why << name(key) << " has kappa " << law.compression / d << " d, in parts " << other.compression / d
                << " d\n";
        if (law.kind == ContactKind::impact && other.kind == law.kind && std::abs(law.target - other.target) > turn)
            why << name(key) << " has target " << law.target << " m/s, in parts " << other.target << " m/s\n";
    }
    for (const auto& [key, law] : split)
        if (law.gap <= -clearly * d && !is_bystander(key) && !whole.contains(key))
            why << name(key) << " is there in parts only\n";
    if (why.str().empty()) return {};
    return {Verdict::Outcome::fails, "in " + std::to_string(parts) + " parts:\n" + why.str() + picture(own) +
                                         "  and in parts:\n" + contact_table(world, parts)};
}

} // namespace

TEST_CASE("P2 what is far away changes no bit of a step, and by the stopping rule no more than its tolerance",
    "[locality][!mayfail]")
{
    hold("locality", unmoved_by_what_is_far);
}

TEST_CASE("P2 a split step has the laws of a whole one", "[locality][!mayfail]")
{
    hold("split", ruled_alike_in_parts);
}

} // namespace talus::test
