// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/placed_wall.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

Simulation simulation_with(const WallMotion& motion)
{
    auto simulation = build_scene(small_scene()).simulation;
    simulation.model.walls[0].motion = motion;
    simulation.model.physics.moving_walls = !motion.empty();
    return simulation;
}

PlacedWall wall_of(const Simulation& simulation)
{
    return place_walls(simulation.model, simulation.state, simulation.model.time_step)[0];
}

const Vec3 corner(0.01, 0.02, 0.03); // of the wall, somewhere

} // namespace

TEST_CASE("a driven wall goes on from where it is, and knows how it moved in the step before", "[interventions]")
{
    const WallMotion motion = GENERATE(WallMotion{}, WallMotion{Translation{{}, Vec3(0.1, 0, 0)}},
        WallMotion{Turning{{}, Vec3::Zero(), Vec3::UnitZ(), 1.0}, Shaking{{}, Vec3(0, 0, 0.001), 20.0}},
        WallMotion{Course{{{0.0, Vec3::Zero()}, {0.05, Vec3(0, 0.01, 0)}, {1.0, Vec3(0, 0, 0.5)}}}});
    auto simulation = simulation_with(motion);
    const double h = simulation.model.time_step;
    while (simulation.state.time < 0.1) advance(simulation);
    const PlacedWall before = wall_of(simulation);
    const Vec3 x = before.pose()(corner);

    drive_wall(simulation, 0, Vec3(0, 0, 0.2));
    const PlacedWall driven = wall_of(simulation);
    CHECK((driven.pose()(corner) - x).norm() < 1e-12);
    CHECK((driven.velocity(0, x) - Vec3(0, 0, 0.2)).norm() < 1e-9);
    CHECK((driven.velocity_before(0, x) - before.velocity_before(0, x)).norm() < 1e-9);
    advance(simulation);
    CHECK((wall_of(simulation).pose()(corner) - x - h * Vec3(0, 0, 0.2)).norm() < 1e-12);
}

TEST_CASE("a wall that is driven anew in every step has gone what its velocities add up to", "[interventions]")
{
    auto simulation = simulation_with({});
    Vec3 way = Vec3::Zero(), last = Vec3::Zero();
    for (int k = 0; k < 50; ++k) {
        const Vec3 velocity(0.01 * k, 0, -0.002 * k);
        drive_wall(simulation, 0, Vec3(5, 5, 5)); // thought better of
        drive_wall(simulation, 0, velocity);
        CHECK((wall_of(simulation).velocity(0, Vec3::Zero()) - velocity).norm() < 1e-9);
        CHECK((wall_of(simulation).velocity_before(0, Vec3::Zero()) - last).norm() < 1e-9);
        advance(simulation);
        way += simulation.model.time_step * velocity;
        last = velocity;
    }
    CHECK((wall_of(simulation).pose().shift - way).norm() < 1e-12);
    CHECK(simulation.model.walls[0].motion.size() <= 3);
}

TEST_CASE("a checkpoint keeps what was done from outside, and takes back what came after it", "[interventions]")
{
    auto simulation = simulation_with({Translation{{}, Vec3(0.1, 0, 0)}});
    set_own_force(simulation, 2, Vec3(0, 0, 1e-3));
    Archive before;
    before(simulation);
    for (int k = 0; k < 5; ++k) advance(simulation);
    drive_wall(simulation, 0, Vec3(0, 0.1, 0));
    for (int k = 0; k < 5; ++k) advance(simulation);
    Archive after;
    after(simulation);

    auto other = simulation_with({Translation{{}, Vec3(0.1, 0, 0)}});
    Archive read_after(after.bytes()), read_before(before.bytes());
    read_after(other);
    CHECK(other.interventions.any);
    CHECK(wall_of(other).pose().shift == wall_of(simulation).pose().shift);
    read_before(other);
    CHECK(other.state.own_force[2].z() == 1e-3);
    CHECK(wall_of(other).velocity(0, Vec3::Zero()).isApprox(Vec3(0.1, 0, 0)));
    for (int k = 0; k < 5; ++k) advance(other);
    drive_wall(other, 0, Vec3(0, 0.1, 0));
    for (int k = 0; k < 5; ++k) advance(other);
    Archive again;
    again(other);
    CHECK(again.bytes() == after.bytes());
}
