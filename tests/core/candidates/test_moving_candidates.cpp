// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_search.hpp"
#include "tests/support/world.hpp"

#include <set>
#include <tuple>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double edge = 0.06;

/// A slab that turns about the vertical through the middle, its corners at this speed and beyond the border of the
/// world; a plate that is shaken; a roof that goes to and fro; a rough belt that runs for ever along x.
void add_moving_walls(World& world, double speed)
{
    const double half = 0.75 * edge;
    const Vec3 middle(0.5 * edge, 0.5 * edge, 0);
    world.add_wall(box_panels({middle - Vec3(half, 0.002, 0), middle + Vec3(half, 0.002, 0.015)}, {"z+", "x-"}),
        {Turning{{}, middle, Vec3::UnitZ(), speed / half}});
    world.add_wall(Disk{Vec3(0.03, 0.03, 0.045), Vec3(0.6, 0, 0.8), 0.02, 0.005},
        {Shaking{{}, Vec3(0, 0.004, 0.002), speed / 0.0045 / 6.283}});
    world.add_wall(make_mesh({Vec3(0, 0, 0.05), Vec3(edge, 0, 0.05), Vec3(edge, edge, 0.055), Vec3(0, edge, 0.06)},
                       {{0, 1, 2}, {0, 2, 3}}),
        {Course{{{0.0, Vec3::Zero()}, {0.02 / speed, Vec3(0, 0, -0.02)}, {0.04 / speed, Vec3::Zero()}}},
            Turning{{0.001, infinity}, middle, Vec3::UnitX(), 0.3 * speed / edge}});
    world.add_wall(grain_bed({Vec3(0, 0, 0.002), Vec3(edge, edge, 0.002)}, 0.006, 0.008),
        {Translation{{}, speed * Vec3::UnitX()}});
}

/// Beads of several sizes that fly about between walls that move.
World stirred_beads(double bead_speed, double wall_speed, const Periodicity& periodicity)
{
    World world =
        make_world({.friction = 0.5, .restitution = 0.5}, production_settings(Stabilisation::projected), 1e-4);
    world.model.gravity = Vec3(0, 0, -1e-3);
    world.model.periodicity = periodicity;
    std::vector<std::string> open;
    if (periodicity.along(0)) open.insert(open.end(), {"x-", "x+"});
    if (periodicity.along(1)) open.insert(open.end(), {"y-", "y+"});
    world.add_wall(box_panels({Vec3::Zero(), Vec3::Constant(edge)}, open));
    add_moving_walls(world, wall_speed);
    Random random(3);
    const auto random_vector = [&] {
        return Vec3(2 * uniform(random) - 1, 2 * uniform(random) - 1, 2 * uniform(random) - 1);
    };
    constexpr double distance = 0.0062;
    for (double x = 0.005; x < edge - 0.004; x += distance)
        for (double y = 0.005; y < edge - 0.004; y += distance)
            for (double z = 0.02; z < edge - 0.02; z += distance)
                world.add_sphere(
                    Vec3(x, y, z), bead_speed * random_vector(), Vec3::Zero(), 0.0015 + 0.0015 * uniform(random));
    return world;
}

double reach_of(const World& world)
{
    return open_contact_reach * world.model.min_diameter;
}

/// How many spheres are within reach of each other; requires that all of these are listed.
std::size_t check_pairs(const World& world)
{
    const auto& state = world.state;
    std::set<std::pair<std::int32_t, std::int32_t>> listed;
    for (const Tile& tile : world.network.list.tiles.tiles)
        for (const auto& pair : tile.pairs) listed.insert({pair.a, pair.b});
    REQUIRE(listed.size() == world.network.list.tiles.pair_count()); // each once
    const auto shifts = world.model.periodicity.neighbor_shifts();
    std::size_t within = 0;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(state.count()); ++i)
        for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(state.count()); ++j) {
            double gap = infinity;
            for (const Vec3& shift : shifts)
                gap = std::min(
                    gap, (state.position[i] - state.position[j] + shift).norm() - state.radius[i] - state.radius[j]);
            if (gap > reach_of(world)) continue;
            ++within;
            if (!listed.count({i, j}))
                FAIL("spheres " << i << " and " << j << " with gap " << gap << " are not listed");
        }
    return within;
}

/// How many patches of the walls, of all their images, are within reach of a sphere or will come near by the wall's own
/// motion in the step. Each must be listed, and is looked at from where the sphere was listed.
std::size_t check_walls(const World& world)
{
    const auto& state = world.state;
    const auto walls = world.placed_walls();
    std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t>> listed;
    for (const auto& pair : world.network.list.wall_pairs)
        for (std::uint32_t k = 0; k < pair.patches; ++k)
            listed.insert({pair.sphere, pair.wall, world.network.list.patches[pair.first + k]});
    REQUIRE(listed.size() == world.network.list.patches.size());
    std::size_t within = 0;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(state.count()); ++i) {
        const Vec3& own = state.position[i];
        const Vec3 x = own + world.model.periodicity.shift_towards(own, world.network.list.listed_box[i].center());
        for (std::int32_t w = 0; w < static_cast<std::int32_t>(walls.size()); ++w)
            for (std::size_t patch = 0; patch < walls[w].patch_count(); ++patch) {
                const auto at = walls[w].nearest_point(patch, x);
                const double gap = at.distance - state.radius[i];
                const double approach = std::max(0.0, at.normal.dot(walls[w].velocity(patch, at.point)));
                if (gap > reach_of(world) + world.model.time_step * approach) continue;
                ++within;
                if (!listed.count({i, w, static_cast<std::int32_t>(patch)}))
                    FAIL("sphere " << i << " and patch " << patch << " of wall " << w << " with gap " << gap
                                   << " are not listed");
            }
    }
    return within;
}

void run_checked(World& world, int steps)
{
    std::size_t pairs = 0, patches = 0;
    for (int k = 0; k < steps; ++k) {
        world.update_candidates();
        pairs += check_pairs(world);
        patches += check_walls(world);
        world.step();
        // Walls that fast may press beads for which rigid contacts have no solution; that is reported, and no harm
        // here.
        for (const Incident& incident : world.report.bodies.incidents)
            REQUIRE(incident.kind == Incident::Kind::pressed);
    }
    CHECK(pairs > 50);
    CHECK(patches > 100);
}

const std::vector<Periodicity> cells = {
    {}, {Vec3::Zero(), Vec3(edge, infinity, infinity)}, {Vec3::Zero(), Vec3(edge, edge, infinity)}};

} // namespace

TEST_CASE("every sphere and wall within reach is listed while walls move, across periodic borders too",
    "[candidate_search][moving_walls][periodicity]")
{
    const auto& periodicity = cells[GENERATE(range<std::size_t>(0, 3))];
    // Slow against the beads, with lists that last; and as fast as a tenth of the largest diameter in a step.
    const auto [bead_speed, wall_speed] = GENERATE(table<double, double>({{0.1, 0.05}, {0.05, 1.0}, {3.0, 6.0}}));
    CAPTURE(periodicity.length.transpose(), bead_speed, wall_speed);
    auto world = stirred_beads(bead_speed, wall_speed, periodicity);
    run_checked(world, 100);
}

TEST_CASE("beads that fly across a periodic border for many cells stay listed", "[candidate_search][periodicity]")
{
    auto world = stirred_beads(0.5, 0.2, cells[2]);
    for (auto& m : world.state.bodies) m.velocity += Vec3(4.0, -3.0, 0);
    run_checked(world, 160);
    for (const Vec3& x : world.state.position) {
        CHECK(x.x() >= 0.0);
        CHECK(x.x() < edge);
    }
}

TEST_CASE("a belt that has run for many cells still carries", "[moving_walls][periodicity]")
{
    // A bed of grains as long as the cell: of all its images, those near the cell are searched.
    World world = make_world({.friction = 0.8}, production_settings(Stabilisation::matched), 2e-4);
    world.model.periodicity = {Vec3(-0.02, 0, 0), Vec3(edge, infinity, infinity)};
    world.add_wall(
        grain_bed({Vec3(-0.02, 0, 0), Vec3(edge - 0.02, 0.03, 0)}, 0.008, 0.006), {Translation{{}, Vec3(-0.4, 0, 0)}});
    const auto sphere = world.add_sphere(Vec3(0, 0.015, 0.01), Vec3(-0.4, 0, 0));
    world.step(5000); // 1 s: six cells and a half
    CHECK(world.position(sphere).z() > 0.003);
    CHECK((world.velocity(sphere) - Vec3(-0.4, 0, 0)).norm() < 0.01);
}

TEST_CASE("a wall that creeps nearer is listed once it is within reach", "[candidate_search][moving_walls]")
{
    // In steps far shorter than its skin, alone and while the sphere creeps towards it too.
    constexpr double diameter = 2.0 * standard_radius, step = 0.002 * diameter;
    const double gap = GENERATE(range(0, 60)) * 0.0101 * diameter;
    const double share = GENERATE(0.0, 0.5); // of the approach that the sphere makes
    const Vec3 direction = GENERATE(Vec3(1, 0, 0), Vec3(1, -5, 2).normalized());
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-4);
    world.model.gravity.setZero();
    world.add_sphere(Vec3::Zero());
    const Vec3 foot = (standard_radius + gap) * direction, across = any_perpendicular(direction);
    world.add_wall(make_mesh({foot - across - direction.cross(across), foot + across, foot + direction.cross(across)},
                       {{0, 1, 2}}),
        {Translation{{}, -(1.0 - share) * step / world.model.time_step * direction}});
    for (int k = 0; k * step < gap + 0.01 * diameter; ++k) {
        world.update_candidates();
        check_walls(world);
        world.state.position[0] += share * step * direction;
        world.state.time += world.model.time_step;
    }
}

TEST_CASE("a wall that turns is searched for by how far it moves where the farthest sphere is, whoever was listed last",
    "[candidate_search][moving_walls]")
{
    // A sheet turns about the z axis. One sphere lies near the axis, where it hardly moves; another is brought out to
    // fifty diameters, where the sheet makes 0.02 diameters in a step and comes by after 75. Each is listed alone.
    constexpr double diameter = 2.0 * standard_radius, out = 50.0 * diameter;
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-4);
    world.model.gravity.setZero();
    world.add_wall(make_mesh({Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(0, 0, 2)}, {{0, 1, 2}}),
        {Turning{{}, Vec3::Zero(), Vec3::UnitZ(), 0.02 * diameter / out / world.model.time_step}});
    world.add_sphere(Vec3(0.05, -2.0 * diameter, 0));
    world.add_sphere(Vec3(0.05, 2.0 * diameter, 0));
    Vec3 &first = world.state.position[0], &second = world.state.position[1];
    std::size_t within = 0;
    for (int k = 0; k < 80; ++k) {
        if (k == 10) second = Vec3(out, 2.0 * diameter, 0);
        if (k == 20) first.z() += 0.5 * diameter;
        CHECK(world.update_candidates() == (k == 0 ? 2 : k == 10 || k == 20 ? 1 : 0));
        Box around;
        for (const Box& box : world.network.list.listed_box) around.extend(box);
        CHECK(around.contains(world.network.list.listed_around));
        CHECK(world.network.list.listed_around.contains(around));
        within = check_walls(world);
        world.state.time += world.model.time_step;
    }
    CHECK(within == 1);
}

TEST_CASE("a wall that turns back after a sphere was listed alone finds it listed", "[candidate_search][moving_walls]")
{
    // It goes away by nearly its skin, and then comes by twice as much: it has moved no further than its skin since it
    // was searched for, but further since the sphere was.
    constexpr double diameter = 2.0 * standard_radius, way = 0.18 * diameter, turn = 0.01; // m, s
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-4);
    world.model.gravity.setZero();
    world.add_sphere(Vec3::Zero());
    const double x = standard_radius + way;
    world.add_wall(make_mesh({Vec3(x, -1, -1), Vec3(x, 1, -1), Vec3(x, 0, 1)}, {{0, 1, 2}}),
        {Course{{{0.0, Vec3::Zero()}, {turn, Vec3(way, 0, 0)}, {3.0 * turn, Vec3(-way, 0, 0)}}}});
    std::size_t within = 0;
    for (int k = 0; k < 300; ++k) {
        world.update_candidates();
        within = check_walls(world);
        if (k == 100) world.state.position[0].y() = 0.5 * diameter; // out of its listed box
        world.state.time += world.model.time_step;
    }
    CHECK(within == 1);
}
