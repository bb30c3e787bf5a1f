// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/region_average.hpp"
#include "tests/support/regions.hpp"
#include "tests/support/sampling.hpp"
#include "tests/support/world.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double r = standard_radius, d = 2.0 * standard_radius;

std::map<std::string, double> values(const std::vector<Measurement>& measurements)
{
    std::map<std::string, double> named;
    for (const Measurement& m : measurements) named[m.name] = m.value;
    return named;
}

/// What a sensor says of a world as it is.
std::map<std::string, double> measure(const World& world, const Region& region)
{
    RegionAverage sensor("there", region, {});
    sensor.sample({world.state, world.model, world.network, world.report});
    return values(sensor.latest());
}

World weightless(const SolverSettings& solver = rigid_settings())
{
    World world = make_world({.friction = 0.0}, solver, 1e-4);
    world.model.gravity.setZero();
    return world;
}

/// A face-centred cubic lattice of n³ cells, whose spheres touch but for a share `apart` of the diameter.
World face_centered_cubic(int n, double apart)
{
    World world = weightless(matched_settings(1e-3, 50));
    const double cell = std::sqrt(2.0) * d * (1.0 + apart);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k)
                for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)})
                    world.add_sphere(cell * (Vec3(i, j, k) + at));
    return world;
}

} // namespace

TEST_CASE("the packing fraction of a face-centred cubic lattice is π/√18 wherever whole cells are cut", "[region]")
{
    const World world = face_centered_cubic(6, 0.0);
    const double cell = std::sqrt(2.0) * d;
    const double expected = std::numbers::pi / std::sqrt(18.0);
    for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(0.13, 0.37, 0.71), Vec3(0.25, 0.25, 0.25)}) {
        const Vec3 min = cell * (shift.array() + 1.0);
        CHECK(measure(world, box(min, min.array() + 2.0 * cell))["packing_fraction"] == Approx(expected).margin(1e-3));
    }
}

TEST_CASE("in a face-centred cubic lattice under pressure every sphere has twelve contacts", "[region]")
{
    World world = face_centered_cubic(4, -1e-4);
    world.step();
    const double cell = std::sqrt(2.0) * d;
    const auto inside = measure(world, box(Vec3::Constant(1.2 * cell), Vec3::Constant(2.3 * cell)));
    CHECK(inside.at("coordination") == Approx(12.0));
    CHECK(inside.at("coordination_without_rattlers") == Approx(12.0));
    CHECK(inside.at("pressure") > 0.0);
    CHECK(inside.at("stress_xx") == Approx(inside.at("stress_zz")).epsilon(0.2)); // the sweeps end at their tolerance
}

TEST_CASE("spheres with fewer than two contacts are rattlers", "[region]")
{
    World world = make_world({.friction = 0.0}, matched_settings(), 2.5e-4);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (const double z : {0.5, 1.5, 2.5}) world.add_sphere(Vec3(0, 0, z * d)); // 2, 2 and 1 contacts
    world.add_sphere(Vec3(2 * d, 0, 5 * d));                                    // in flight
    world.step(20);
    const auto column = measure(world, box(Vec3(-d, -d, -d), Vec3(3 * d, d, 6 * d)));
    CHECK(column.at("coordination") == Approx(5.0 / 4.0));
    CHECK(column.at("coordination_without_rattlers") == Approx(2.0));
}

TEST_CASE("velocity and granular temperature are those of the velocities given", "[region]")
{
    // Speeds u ± w along each axis: a variance of w² in each direction, so T = w².
    const Vec3 u(0.3, -0.2, 1.0);
    World world = weightless();
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            const Vec3 w = sign * std::sqrt(3.0) * 0.5 * Vec3::Unit(axis);
            world.add_sphere(Vec3(axis, sign, 0), u + w);
        }
    const double volume = 10.0 * 10.0 * 10.0;
    const auto gas = measure(world, box(Vec3::Constant(-5.0), Vec3::Constant(5.0)));
    CHECK(gas.at("velocity_x") == Approx(u.x()));
    CHECK(gas.at("velocity_y") == Approx(u.y()));
    CHECK(gas.at("velocity_z") == Approx(u.z()));
    CHECK(gas.at("granular_temperature") == Approx(0.25));
    // The kinetic pressure is the bulk density times the temperature.
    CHECK(gas.at("pressure") == Approx(6.0 * world.mass() / volume * 0.25));
    CHECK(gas.at("stress_xy") == Approx(0.0).margin(1e-15));
    CHECK(std::isnan(gas.at("coordination_without_rattlers")));
}

TEST_CASE("the stress of two spheres that hit is their force times their distance", "[region]")
{
    // Head-on, plastic, along (1, 1, 0)/√2: the impulse m w stops both; f = m w / h.
    const double w = 0.2;
    const Vec3 n = Vec3(1, 1, 0).normalized();
    World world = weightless();
    world.add_sphere(r * n, -w * n);
    world.add_sphere(-r * n, w * n);
    world.step();
    const double force = world.mass() * w / world.model.time_step;
    const double volume = 8e-3, stress = force * d / volume;
    const Region around = box(Vec3::Constant(-0.1), Vec3::Constant(0.1));
    const auto pair = measure(world, around);
    CHECK(pair.at("stress_xx") == Approx(0.5 * stress).epsilon(1e-9));
    CHECK(pair.at("stress_yy") == Approx(0.5 * stress).epsilon(1e-9));
    CHECK(pair.at("stress_xy") == Approx(0.5 * stress).epsilon(1e-9));
    CHECK(pair.at("stress_zz") == Approx(0.0).margin(1e-9 * stress));
    CHECK(pair.at("stress_yz") == Approx(0.0).margin(1e-9 * stress));
    CHECK(pair.at("pressure") == Approx(stress / 3.0).epsilon(1e-9));

    // A region that holds a quarter of the branch knows of a quarter of it.
    const Region half = box(Vec3(0.5 * r * n.x(), -0.1, -0.1), Vec3(0.2, 0.1, 0.1));
    CHECK(measure(world, half)["pressure"] * (0.2 - 0.5 * r * n.x()) * 0.04 ==
          Approx(0.25 * stress / 3.0 * volume).epsilon(1e-9));
}

TEST_CASE("the vertical stress in a column is the weight above over the area", "[region]")
{
    constexpr int n = 8;
    World world = make_world({.friction = 0.3}, rigid_settings(), 2.5e-4);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < n; ++k) world.add_sphere(Vec3(0, 0, (k + 0.5) * d));
    world.step(3);
    const double area = 9.0 * d * d, weight = world.mass() * standard_gravity;
    for (const double z : {0.2, 1.0, 3.7, 6.6}) { // between two centres the force is that of the spheres above
        const auto slice =
            measure(world, box(Vec3(-1.5 * d, -1.5 * d, (z - 0.1) * d), Vec3(1.5 * d, 1.5 * d, (z + 0.1) * d)));
        CHECK(slice.at("stress_zz") == Approx(weight * (n - std::floor(z + 0.5)) / area).epsilon(1e-6));
    }
    const auto all = measure(world, box(Vec3(-1.5 * d, -1.5 * d, 0), Vec3(1.5 * d, 1.5 * d, n * d)));
    // Σ f l: n weights over r, n − 1 over d, … : r n + d n (n − 1) / 2.
    CHECK(all.at("stress_zz") == Approx(weight * (0.5 * n + 0.5 * n * (n - 1.0)) / n / area).epsilon(1e-6));
}

TEST_CASE("only samples in the window count, and the error is that of their mean", "[region]")
{
    State state;
    Model model;
    model.time_step = 1e-3;
    add_sphere(state, Vec3::Zero(), r, 2500.0, 0);
    RegionAverage sensor("there", box(Vec3::Constant(-d), Vec3::Constant(d)), {1.0, 2.0});
    for (int k = 0; k <= 300; ++k) {
        state.time = 0.01 * k;
        const bool steady = state.time >= 1.0 && state.time <= 2.0;
        state.body(0).velocity.x() = steady ? (k % 2 == 0 ? 1.0 : 3.0) : 100.0;
        sample(sensor, state, model);
    }
    const auto velocity = sensor.results()[3];
    CHECK(velocity.name == "velocity_x");
    CHECK(velocity.value == Approx(2.0).margin(0.02)); // one sample of 101 has no partner
    CHECK(velocity.spread < 0.01);                     // the blocks are of even length
    CHECK(sensor.latest()[3].value == 100.0);
}

TEST_CASE("a region that never holds anything has nothing to measure", "[region][degenerate]")
{
    State state;
    Model model;
    model.time_step = 1e-3;
    RegionAverage sensor("nowhere", box(Vec3::Zero(), Vec3::Ones()), {});
    CHECK(std::isnan(values(sensor.latest())["packing_fraction"]));
    sample(sensor, state, model);
    auto empty = values(sensor.latest());
    CHECK(empty["packing_fraction"] == 0.0);
    CHECK(empty["pressure"] == 0.0);
    CHECK(std::isnan(empty["velocity_x"]));
    CHECK(std::isnan(empty["granular_temperature"]));
    CHECK(std::isnan(empty["coordination"]));
    for (const Measurement& result : sensor.results()) CHECK(std::isnan(result.value));
    CHECK(sensor.silence() == "there was nothing to measure");
}

TEST_CASE("a region sensor that was stored goes on as if nothing had been", "[region][persist]")
{
    World world = make_world({.friction = 0.3}, matched_settings(), 2.5e-4);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < 3; ++k) world.add_sphere(Vec3(0.1 * d * k, 0, (1.2 * k + 0.6) * d));
    const Region region = box(Vec3(-d, -d, 0), Vec3(d, d, 3 * d));
    RegionAverage whole("a", region, {}), first("a", region, {}), second("a", region, {});
    const auto watch = [&](RegionAverage& sensor) {
        sensor.sample({world.state, world.model, world.network, world.report});
    };
    for (int k = 0; k < 30; ++k) {
        world.step(10);
        watch(whole);
        watch(k < 15 ? first : second);
        if (k != 14) continue;
        Archive stored;
        first.persist(stored);
        Archive archive(stored.bytes());
        second.persist(archive);
        REQUIRE(archive.at_end());
        CHECK(second.latest()[0].value == first.latest()[0].value);
    }
    const auto expected = whole.results(), results = second.results();
    for (std::size_t k = 0; k < expected.size(); ++k) {
        INFO(expected[k].name);
        CHECK(results[k].value == expected[k].value);
        CHECK(results[k].spread == expected[k].spread);
    }
}

TEST_CASE("the branch of a contact is as long as the centres are apart, however much the spheres overlap", "[region]")
{
    World world = weightless(matched_settings());
    world.model.solver.push_out_speed = 0.1;
    const double distance = 0.8 * d;
    world.add_sphere(Vec3::Zero());
    world.add_sphere(Vec3(distance, 0, 0));
    world.step();
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    const double flux = 2.0 * world.mass() * std::pow(world.state.body(0).velocity.x(), 2);
    const double edge = 6.0 * d;
    const auto there = measure(world, box(Vec3::Constant(-0.5 * edge), Vec3::Constant(0.5 * edge)));
    CHECK(there.at("stress_xx") * edge * edge * edge == Approx(forces[0].normal_force * distance + flux).epsilon(1e-9));
}
