// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/wall_force.hpp"
#include "tests/support/world.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2.0 * standard_radius;

/// Steps with a sensor that watches every step and samples the last one.
void step_with(World& world, WallForce& sensor, int count)
{
    for (int k = 0; k < count; ++k) {
        world.step();
        sensor.watch({world.state, world.model, world.network, world.report});
    }
    sensor.sample({world.state, world.model, world.network, world.report});
}

/// An empty world above a floor; rolling resistance keeps heaps from flowing.
World with_wall_loads(const SolverSettings& solver)
{
    World world = make_world({.friction = 0.5, .rolling_friction = 0.3}, solver, 2.5e-4);
    world.model.physics.wall_loads = true;
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    return world;
}

} // namespace

TEST_CASE("a sphere at rest presses on the floor with its weight, which turns it about a point beside", "[wall_force]")
{
    World world = with_wall_loads(rigid_settings());
    world.add_sphere(Vec3(0.03, 0.02, standard_radius));
    const Vec3 point(0.01, 0.05, 0.7);
    WallForce sensor("floor", 0, point, {});
    step_with(world, sensor, 50);
    const double weight = world.mass() * standard_gravity;
    const auto load = sensor.results();
    CHECK(load[2].name == "force_z");
    CHECK(load[2].value == Approx(-weight).epsilon(1e-9));
    CHECK(load[0].value == Approx(0.0).margin(1e-9 * weight));
    // (0.02, −0.03, −0.7) × (0, 0, −weight)
    CHECK(load[3].name == "torque_x");
    CHECK(load[3].unit == "N m");
    CHECK(load[3].value == Approx(0.03 * weight).epsilon(1e-9));
    CHECK(load[4].value == Approx(0.02 * weight).epsilon(1e-9));
    CHECK(load[5].value == Approx(0.0).margin(1e-9 * weight));
    CHECK(load[2].spread < 1e-9 * weight);
}

TEST_CASE("a heap at rest presses on the floor with its weight, and its torque balances", "[wall_force]")
{
    // Ten spheres heaped up in a tetrahedron, three layers high, with room between those of the lowest.
    World world = with_wall_loads(production_settings(Stabilisation::matched));
    const double a = 1.001 * d, rise = std::sqrt(2.0 / 3.0) * a;
    for (int layer = 0; layer < 3; ++layer)
        for (int i = 0; i < 3 - layer; ++i)
            for (int j = 0; j < 3 - layer - i; ++j)
                world.add_sphere(Vec3(a * (i + 0.5 * j + 0.5 * layer),
                    a * (std::sqrt(0.75) * j + std::sqrt(1.0 / 12.0) * layer), standard_radius + rise * layer));
    world.step(2000);
    Vec3 center = Vec3::Zero(); // of mass
    for (const Vec3& x : world.state.position) center += x / 10.0;
    WallForce sensor("floor", 0, Vec3(center.x(), center.y(), 0.0), {});
    step_with(world, sensor, 400);
    const double weight = 10.0 * world.mass() * standard_gravity;
    const auto load = sensor.results();
    const double tolerance = world.model.solver.tolerance;
    CHECK(load[2].value == Approx(-weight).epsilon(tolerance));
    for (const int k : {0, 1}) CHECK(load[static_cast<std::size_t>(k)].value == Approx(0.0).margin(tolerance * weight));
    for (const int k : {3, 4, 5})
        CHECK(load[static_cast<std::size_t>(k)].value == Approx(0.0).margin(tolerance * weight * d));
}

TEST_CASE("the walls of a box bear together what a sphere in it weighs", "[wall_force]")
{
    // In the corner of two walls at 45°: each bears weight / √2, half of it upwards.
    World world = make_world({.friction = 0.0}, rigid_settings(), 2.5e-4);
    world.model.physics.wall_loads = true;
    world.add_plane(Vec3::Zero(), Vec3(1, 0, 1).normalized());
    world.add_plane(Vec3::Zero(), Vec3(-1, 0, 1).normalized());
    world.add_sphere(Vec3(0, 0, std::sqrt(2.0) * standard_radius));
    WallForce left("left", 0, Vec3::Zero(), {}), right("right", 1, Vec3::Zero(), {});
    for (int k = 0; k < 20; ++k) {
        world.step();
        for (WallForce* sensor : {&left, &right})
            sensor->watch({world.state, world.model, world.network, world.report});
    }
    const double half = 0.5 * world.mass() * standard_gravity;
    CHECK(left.results()[0].value == Approx(-half).epsilon(1e-9));
    CHECK(left.results()[2].value == Approx(-half).epsilon(1e-9));
    CHECK(right.results()[0].value == Approx(half).epsilon(1e-9));
    CHECK(right.results()[2].value == Approx(-half).epsilon(1e-9));
}

TEST_CASE(
    "a sample is the mean over every step since the last one, and the results are over the window", "[wall_force]")
{
    State state;
    ContactNetwork network;
    Model model;
    model.time_step = 0.5;
    model.walls.assign(2, {"wall", Plane{Vec3::Zero(), Vec3::UnitZ()}, 0});
    StepReport report;
    WallForce sensor("wall", 1, Vec3::Zero(), {3.5, 5.0});
    for (int k = 1; k <= 12; ++k) {
        state.time = model.time_step * k;
        report.wall_loads.assign(2, WallLoad{});
        report.wall_loads[1].impulse.x() = 0.5 * k; // a force of k newton
        sensor.watch({state, model, network, report});
        if (k == 4) sensor.sample({state, model, network, report});
    }
    CHECK(sensor.latest()[0].value == Approx(2.5)); // of 1 to 4
    sensor.sample({state, model, network, report});
    CHECK(sensor.latest()[0].value == Approx(8.5)); // of 5 to 12
    sensor.sample({state, model, network, report});
    CHECK(sensor.latest()[0].value == Approx(8.5));  // no step since
    CHECK(sensor.results()[0].value == Approx(8.5)); // of 7 to 10
}

TEST_CASE("the mean of a wall force is over the time in which the wall stands", "[wall_force]")
{
    World world = with_wall_loads(matched_settings());
    world.model.walls[0].appear_at = 0.05;
    world.model.walls[0].remove_at = 0.35;
    world.model.gravity = Vec3(0, 0, -1e-9); // what is thrown up stays there
    WallForce sensor("gate", 0, Vec3::Zero(), {0.1, 10.0});
    world.add_sphere(Vec3(0, 0, standard_radius), Vec3::Zero());
    world.state.own_force.assign(1, Vec3(0, 0, -1.0));
    for (int k = 0; k < 2000; ++k) {
        world.state.own_force[0].z() = world.model.walls[0].stands_at(world.state.time) ? -1.0 : 0.0;
        step_with(world, sensor, 1);
    }
    CHECK(world.state.time > 0.45);
    CHECK(sensor.results()[2].value == Approx(-1.0).epsilon(1e-3)); // not less for the time without it
    CHECK(std::isnan(sensor.latest()[2].value));
}

TEST_CASE("a wall force that was stored goes on as if nothing had been", "[wall_force][persist]")
{
    World world = with_wall_loads(matched_settings());
    world.add_sphere(Vec3(0.01, 0, 2.0 * d), Vec3(1, 0, 0));
    WallForce whole("a", 0, Vec3::Zero(), {}), first("a", 0, Vec3::Zero(), {}), second("a", 0, Vec3::Zero(), {});
    for (int k = 0; k < 500; ++k) {
        world.step();
        const Snapshot now{world.state, world.model, world.network, world.report};
        for (WallForce* sensor : {&whole, k < 255 ? &first : &second}) {
            sensor->watch(now);
            if (k % 10 == 0) sensor->sample(now);
        }
        if (k != 254) continue;
        Archive stored;
        first.persist(stored);
        Archive archive(stored.bytes());
        second.persist(archive);
        REQUIRE(archive.at_end());
    }
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(second.latest()[k].value == whole.latest()[k].value);
        CHECK(second.results()[k].value == whole.results()[k].value);
        CHECK(second.results()[k].spread == whole.results()[k].spread);
    }
}
