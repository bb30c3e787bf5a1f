// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_search.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double edge = 0.06;

/// A closed box of beads without gravity that fly about and bounce back as fast as they came, an inclined plate of two
/// triangles in it, and a funnel.
World agitated_beads(double speed, double size_ratio, std::uint64_t seed)
{
    SolverSettings solver = production_settings(Stabilisation::projected);
    World world = make_world({.friction = 0.5, .restitution = 1.0}, solver, 1e-4);
    world.model.gravity = Vec3(0, 0, -1e-3);
    world.add_wall(box_panels({Vec3::Zero(), Vec3::Constant(edge)}, {}));
    world.add_wall(make_mesh(
        {Vec3(0, 0, 0), Vec3(edge, 0, 0.02), Vec3(edge, edge, 0.02), Vec3(0, edge, 0)}, {{0, 1, 2}, {0, 2, 3}}));
    world.add_wall(Cone{Vec3(0.03, 0.03, 0.035), Vec3::UnitZ(), 0.01, 0.028, 0.02});
    Random random(seed);
    const auto random_vector = [&] {
        return Vec3(2 * uniform(random) - 1, 2 * uniform(random) - 1, 2 * uniform(random) - 1);
    };
    constexpr double distance = 0.0085;
    for (double x = 0.005; x < edge - 0.004; x += distance)
        for (double y = 0.005; y < edge - 0.004; y += distance)
            for (double z = 0.027; z < edge - 0.004; z += distance) {
                const double radius = 0.004 / (1.0 + (size_ratio - 1.0) * uniform(random));
                world.add_sphere(Vec3(x, y, z), speed * random_vector(), Vec3::Zero(), radius);
            }
    return world;
}

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

Pairs listed_pairs(const ContactNetwork& network)
{
    Pairs pairs;
    for (const Tile& tile : network.list.tiles.tiles)
        for (const auto& pair : tile.pairs) pairs.insert({pair.a, pair.b});
    return pairs;
}

/// Whether two tiles of one colour have pairs with the same sphere: threads would move it at once.
bool tiles_share_spheres(const Tiles& tiles)
{
    for (std::size_t color = 0; color < Tiles::colors; ++color) {
        std::map<std::int32_t, std::size_t> tile_of;
        for (std::size_t t = tiles.color_first[color]; t < tiles.color_first[color + 1]; ++t)
            for (const IndexPair& pair : tiles.tiles[t].pairs)
                for (const auto i : {pair.a, pair.b})
                    if (tile_of.try_emplace(i, t).first->second != t) return true;
    }
    return false;
}

/// How many spheres are within reach of each other; requires that all of these are listed, in tiles that do not share
/// them.
std::size_t check_pairs(const World& world)
{
    REQUIRE_FALSE(tiles_share_spheres(world.network.list.tiles));
    const auto& state = world.state;
    const double reach = open_contact_reach * world.model.min_diameter;
    const auto listed = listed_pairs(world.network);
    REQUIRE(listed.size() == world.network.list.tiles.pair_count()); // each once
    std::size_t within = 0;
    for (std::size_t i = 0; i < state.count(); ++i)
        for (std::size_t j = i + 1; j < state.count(); ++j) {
            const double gap = (state.position[i] - state.position[j]).norm() - state.radius[i] - state.radius[j];
            if (gap > reach) continue;
            ++within;
            if (!listed.count({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)}))
                FAIL("spheres " << i << " and " << j << " with gap " << gap << " are not listed");
        }
    return within;
}

/// How many patches of walls are within reach of a sphere; each must be listed.
std::size_t check_walls(const World& world)
{
    const auto& state = world.state;
    const double reach = open_contact_reach * world.model.min_diameter;
    std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t>> listed;
    for (const auto& pair : world.network.list.wall_pairs)
        for (std::uint32_t k = 0; k < pair.patches; ++k)
            listed.insert({pair.sphere, pair.wall, world.network.list.patches[pair.first + k]});
    std::size_t within = 0;
    for (std::size_t i = 0; i < state.count(); ++i)
        for (std::size_t w = 0; w < world.model.walls.size(); ++w) {
            const auto& shape = world.model.walls[w].shape;
            for (std::size_t patch = 0; patch < patch_count(shape); ++patch) {
                const double gap = nearest_point(shape, patch, state.position[i]).distance - state.radius[i];
                if (gap > reach) continue;
                ++within;
                if (!listed.count(
                        {static_cast<std::int32_t>(i), static_cast<std::int32_t>(w), static_cast<std::int32_t>(patch)}))
                    FAIL("sphere " << i << " and patch " << patch << " of wall " << w << " with gap " << gap
                                   << " are not listed");
            }
        }
    return within;
}

/// What was within reach in all steps of a checked run.
struct Seen {
    std::size_t pairs = 0;
    std::size_t patches = 0;
};

/// Steps, and checks the list each time before it is used.
void run_checked(World& world, int steps, Seen& seen)
{
    for (int k = 0; k < steps; ++k) {
        world.update_candidates();
        seen.pairs += check_pairs(world);
        seen.patches += check_walls(world);
        world.step();
        REQUIRE(world.report.bodies.incidents.empty());
    }
}

} // namespace

TEST_CASE("every sphere and wall within reach is listed at every step", "[candidate_search]")
{
    const double speed = GENERATE(0.3, 3.0, 8.0); // 8 m/s is a tenth of a diameter in a step
    const double size_ratio = GENERATE(1.0, 3.0);
    CAPTURE(speed, size_ratio);
    auto world = agitated_beads(speed, size_ratio, 1);
    Seen seen;
    run_checked(world, 600, seen);
    CHECK(seen.pairs > 50);
    CHECK(seen.patches > 100);
}

TEST_CASE("every sphere and wall within reach is listed while a heap falls and settles", "[candidate_search]")
{
    auto world = agitated_beads(0.3, 2.0, 4);
    world.model.gravity = Vec3(0, 0, -9.81);
    for (auto& law : world.model.materials.laws) law.restitution = 0.0;
    Seen seen;
    run_checked(world, 1500, seen);
    CHECK(seen.pairs > 50 * 1500); // of 196 beads, most of which lie in a heap at the end
    CHECK(seen.patches > 1500);
}

TEST_CASE("what creeps nearer is listed once it is within reach, from any distance and direction", "[candidate_search]")
{
    // In steps far shorter than the skin, so that the list is used for as long as it just holds.
    constexpr double diameter = 2.0 * standard_radius, step = 0.001 * diameter;
    const Vec3 direction = GENERATE(Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1, 1, 0).normalized(),
        Vec3(1, 1, 1).normalized(), Vec3(1, -5, 2).normalized());
    const double gap = GENERATE(range(0, 90)) * 0.0033 * diameter;
    CAPTURE(gap / diameter, direction.transpose());
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-4);
    world.model.gravity.setZero();
    world.add_sphere(Vec3::Zero());
    const auto creep = [&](const Vec3& first, const Vec3& second) {
        for (int k = 0; k * step < gap + 0.01 * diameter; ++k) {
            world.update_candidates();
            check_pairs(world);
            check_walls(world);
            world.state.position[0] += first;
            if (world.state.count() > 1) world.state.position[1] += second;
        }
    };
    SECTION("two spheres, both of which move")
    {
        world.add_sphere((diameter + gap) * direction);
        creep(0.5 * step * direction, -0.5 * step * direction);
    }
    SECTION("two spheres, one of which moves")
    {
        world.add_sphere((diameter + gap) * direction);
        creep(step * direction, Vec3::Zero());
    }
    SECTION("a sphere and a triangle")
    {
        const Vec3 across = any_perpendicular(direction), foot = (standard_radius + gap) * direction;
        world.add_wall(make_mesh(
            {foot - across - direction.cross(across), foot + across, foot + direction.cross(across)}, {{0, 1, 2}}));
        creep(step * direction, Vec3::Zero());
    }
}

TEST_CASE("spheres that come and go leave the list complete", "[candidate_search]")
{
    auto world = agitated_beads(3.0, 2.0, 2);
    Seen seen;
    for (int round = 0; round < 20; ++round) {
        run_checked(world, 10, seen);
        // Eight in nine stay, now and then in reverse order; then a new one comes.
        const auto old_count = static_cast<std::int32_t>(world.state.count());
        std::vector<std::int32_t> new_index(world.state.count(), -1);
        std::int32_t kept = 0;
        for (std::int32_t i = 0; i < old_count; ++i)
            if (old_count < 30 || (i + round) % 9 != 0) new_index[static_cast<std::size_t>(i)] = kept++;
        renumber_spheres(world.state, new_index, static_cast<std::size_t>(kept));
        remove_candidates(world.network.list, world.network.carried, new_index);
        if (round % 2 == 0) {
            std::vector<std::int32_t> reversed;
            for (std::int32_t i = kept; i-- > 0;) reversed.push_back(i);
            renumber_spheres(world.state, reversed, reversed.size());
            renumber_candidates(world.network.list, world.network.carried, world.state, world.model, reversed);
        }
        world.add_sphere(Vec3(0.03, 0.03, 0.03), Vec3(1, 0, 0), Vec3::Zero(), 0.002);
    }
    CHECK(seen.pairs > 50);
    CHECK(seen.patches > 100);
}

TEST_CASE("impulses stay with their pair when the list is rebuilt and renumbered", "[candidate_search]")
{
    // A row of beads that overlap their neighbours; contact i carries (i + 1, 0, 0) from the bead of lower index.
    World world = make_world({.friction = 0.5}, production_settings(Stabilisation::matched), 1e-4);
    for (int i = 0; i < 20; ++i) world.add_sphere(Vec3(0.0099 * i, 0, 0));
    world.update_candidates();
    const auto carried_of = [&](std::int32_t a, std::int32_t b) -> CarriedContact& {
        const IndexPair pair{std::min(a, b), std::max(a, b)};
        for (Tile& tile : world.network.list.tiles.tiles)
            for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot)
                if (tile.pairs[slot] == pair) return tile.carried.contact[slot];
        throw std::logic_error("not listed");
    };
    for (std::int32_t i = 0; i < 19; ++i) {
        CarriedContact& carried = carried_of(i, i + 1);
        carried.impulse = Vec3(i + 1, 0, 0);
        carried.touch.note(TouchRecord::loaded);
    }
    std::vector<std::int32_t> new_index(20);
    for (std::int32_t i = 0; i < 20; ++i) new_index[static_cast<std::size_t>(i)] = (7 * i) % 20;
    renumber_spheres(world.state, new_index, 20);
    renumber_candidates(world.network.list, world.network.carried, world.state, world.model, new_index);
    for (auto& x : world.state.position) x.y() += 0.01; // all leave their boxes and are listed anew
    CHECK(world.update_candidates() == 20);

    for (std::int32_t i = 0; i < 19; ++i) {
        const auto a = (7 * i) % 20, b = (7 * (i + 1)) % 20;
        // On the bead of lower storage index: turned round where that is now the other one.
        const CarriedContact& carried = carried_of(a, b);
        CHECK(carried.impulse == (a < b ? 1.0 : -1.0) * Vec3(i + 1, 0, 0));
        CHECK(carried.touch.is_loaded());
    }
}

TEST_CASE(
    "a sphere that crosses several others in a step makes larger tiles, and nothing is lost", "[candidate_search]")
{
    // Rows of beads that touch their neighbours; one flies over them by two diameters a step, to and fro.
    constexpr double diameter = 2.0 * standard_radius, time_step = 1e-4;
    const double per_step = GENERATE(0.5, 2.0, 5.0);
    World world = make_world({.friction = 0.5}, production_settings(Stabilisation::matched), time_step);
    world.model.gravity.setZero();
    for (int i = 0; i < 30; ++i)
        for (int j = 0; j < 12; ++j) world.add_sphere(diameter * Vec3(i, j, 0));
    const auto fast = static_cast<std::size_t>(world.add_sphere(diameter * Vec3(1, 5, 1.005)));
    world.update_candidates();
    const double usual_edge = world.network.list.tile_edge;
    for (Tile& tile : world.network.list.tiles.tiles)
        for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot)
            tile.carried.contact[slot].impulse.x() = tile.pairs[slot].a + 1000.0 * tile.pairs[slot].b;
    Vec3& velocity = world.state.body(fast).velocity;
    velocity.x() = per_step * diameter / time_step;
    std::size_t within = 0;
    for (int step = 0; step < 40; ++step) {
        Vec3& x = world.state.position[fast];
        if (x.x() + time_step * velocity.x() > 29 * diameter || x.x() + time_step * velocity.x() < 0.0)
            velocity *= -1.0;
        world.update_candidates();
        within += check_pairs(world) - 30 * 11 - 29 * 12;
        x += time_step * velocity;
    }
    CHECK(within >= 20); // it comes by over one where it is over one
    CHECK((world.network.list.tile_edge > usual_edge) == (per_step > 1.0));
    for (const Tile& tile : world.network.list.tiles.tiles)
        for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot) {
            const auto [a, b] = tile.pairs[slot];
            if (b == static_cast<std::int32_t>(fast)) continue;
            CHECK(tile.carried.contact[slot].impulse.x() == a + 1000.0 * b);
        }
}

TEST_CASE("spheres at rest are not searched for again", "[candidate_search]")
{
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-4);
    world.model.gravity.setZero();
    for (int i = 0; i < 10; ++i) world.add_sphere(Vec3(0.011 * i, 0, 0));
    CHECK(world.update_candidates() == 10);
    CHECK(world.update_candidates() == 0);
    world.state.position[3].z() += 0.002;
    CHECK(world.update_candidates() == 1);
}

TEST_CASE("no spheres have no candidates", "[candidate_search][degenerate]")
{
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-4);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    CHECK(world.update_candidates() == 0);
    world.step();
    CHECK(world.report.search.candidates == 0);
}
