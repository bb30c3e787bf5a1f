// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/removal.hpp"
#include "tests/support/world.hpp"

#include <set>

using namespace talus;
using namespace talus::test;

namespace
{

Region below(double height)
{
    Region region;
    region.box = {Vec3(-1, -1, -1), Vec3(1, 1, height)};
    return region;
}

/// A column of beads 20 mm apart that falls towards an outlet, each of another size.
World falling_column(int count)
{
    World world = make_world({}, production_settings(Stabilisation::matched), 1e-3);
    world.model.outlets.push_back(below(-0.05));
    for (int i = 0; i < count; ++i)
        world.add_sphere(Vec3(0, 0, 0.02 * i), Vec3::Zero(), Vec3::Zero(), 0.005 - 1e-4 * i);
    return world;
}

} // namespace

TEST_CASE("what has left and what is inside are together what was inserted", "[outlet]")
{
    World world = falling_column(10);
    double mass = 0.0;
    for (std::size_t i = 0; i < world.state.count(); ++i) mass += world.state.mass(i);
    Outflow outflow;
    std::int64_t before = 0;
    while (world.state.count() > 0) {
        world.step();
        empty_outlets(outflow, world.state, world.network);
        double inside = 0.0;
        for (std::size_t i = 0; i < world.state.count(); ++i) inside += world.state.mass(i);
        CHECK(outflow.count + static_cast<std::int64_t>(world.state.count()) == world.state.next_id);
        CHECK(outflow.mass + inside == Approx(mass));
        CHECK(outflow.count >= before);
        before = outflow.count;
        REQUIRE(world.state.time < 1.0);
    }
    CHECK(outflow.count == 10);
}

TEST_CASE("spheres leave lowest first and the others keep their ids", "[outlet]")
{
    World world = falling_column(5);
    Outflow outflow;
    while (outflow.count < 2) {
        world.step();
        empty_outlets(outflow, world.state, world.network);
    }
    CHECK(std::set(world.state.id.begin(), world.state.id.end()) == std::set<std::int64_t>{2, 3, 4});
    CHECK(world.radius(3) == Approx(0.005 - 3e-4));
}

TEST_CASE("a sphere that was in an outlet leaves even if it is out of it again", "[outlet]")
{
    World world = falling_column(1);
    // A thin outlet, crossed between two emptyings.
    world.model.outlets[0].box = {Vec3(-1, -1, -0.01), Vec3(1, 1, -0.009)};
    world.step(200); // 0.2 s: 0.2 m below it
    REQUIRE(world.position(0).z() < -0.1);
    Outflow outflow;
    empty_outlets(outflow, world.state, world.network);
    CHECK(outflow.count == 1);
    CHECK(world.state.count() == 0);
}

TEST_CASE("a sphere counts as inside until its centre is in the outlet", "[outlet]")
{
    World world = falling_column(1);
    world.model.gravity.setZero();
    world.state.position[0].z() = -0.0499; // its surface is in already
    Outflow outflow;
    world.step();
    empty_outlets(outflow, world.state, world.network);
    CHECK(outflow.count == 0);
}
