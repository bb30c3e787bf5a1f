// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/wall_position.hpp"
#include "tests/support/world.hpp"

#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double h = 1e-3;

/// A plate that a load of 6 N lifts along its guide with 2 m/s², and a sphere far away.
World lifted_plate()
{
    World world = make_world({}, production_settings(Stabilisation::matched), h);
    world.model.gravity.setZero();
    world.add_sphere(Vec3(5, 5, 5));
    world.add_piston(Disk{Vec3(1, 2, 3), Vec3::UnitZ(), 0.1, 0.0}, 3.0, Vec3(1, 0, 1), {{0.0, 6.0}});
    return world;
}

double value(const std::vector<Measurement>& all, const std::string& name)
{
    for (const Measurement& m : all)
        if (m.name == name) return m.value;
    return std::nan("");
}

} // namespace

TEST_CASE("the position of a plate is reported along its guide, with its speed and the load", "[wall_position]")
{
    World world = lifted_plate();
    WallPosition sensor("plate", 0, {});
    CHECK(std::isnan(value(sensor.latest(), "travel")));
    for (int k = 0; k < 100; ++k) {
        world.step();
        sensor.watch({world.state, world.model, world.network, world.report});
    }
    sensor.sample({world.state, world.model, world.network, world.report});
    // v = a n h, x = ½ a h² n (n + 1); the mean over n = 1 … N of these is a h (N + 1)/2 and a h² (N + 1)(N + 2)/6.
    CHECK(value(sensor.latest(), "speed") == within(1e-12, 2.0 * 0.1));
    CHECK(value(sensor.latest(), "travel") == within(1e-12, 2.0 * h * h * 0.5 * 100 * 101));
    CHECK(value(sensor.latest(), "load") == 6.0);
    CHECK(value(sensor.results(), "speed") == within(1e-12, 2.0 * h * 101 / 2));
    CHECK(value(sensor.results(), "travel") == within(1e-12, 2.0 * h * h * 101 * 102 / 6));
    CHECK(sensor.latest()[0].unit == "m");
}

TEST_CASE("a plate that is held has no load yet, and results are of their window alone", "[wall_position]")
{
    World world = lifted_plate();
    world.model.pistons[0].released_at = 49.5 * h;
    WallPosition held("held", 0, {0.0, 40.5 * h}), free("free", 0, {51.5 * h, 1.0});
    for (int k = 0; k < 100; ++k) {
        world.step();
        held.watch({world.state, world.model, world.network, world.report});
        free.watch({world.state, world.model, world.network, world.report});
    }
    CHECK(value(held.results(), "load") == 0.0);
    CHECK(value(held.results(), "travel") == Approx(0.0).margin(1e-12));
    CHECK(value(free.results(), "load") == 6.0);
    CHECK(value(free.results(), "travel") > 0.0);
}
