// SPDX-License-Identifier: GPL-3.0-or-later
// The confined compression of a bed under a loaded plate.
#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <cstdio>

using namespace talus;
using namespace talus::test;

namespace
{

double weight_of_spheres(const Simulation& simulation)
{
    double mass = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i) mass += simulation.state.mass(i);
    return mass * simulation.model.gravity.norm();
}

/// The scene with fewer spheres, lowered onto them on a winch and then loaded so, times from the moment that the plate
/// lies there with its whole weight.
Simulation pressed(const std::vector<LoadPoint>& load)
{
    constexpr double lies = 0.9;
    std::string rows = "wall.plate.load=[[0.3, -17], [0.4, -19.62], [0.8, -19.62], [0.9, 0]";
    for (const auto& [time, force] : load) {
        char row[60];
        std::snprintf(row, sizeof row, ", [%g, %g]", lies + time, force);
        rows += row;
    }
    return open_scene("piston", {"fill.0.count=1500", "wall.plate.center=[0, 0, 0.085]", "wall.plate.released_at=0.25",
                                    "fill.0.region.height=0.08", "sensor.plate.from=1.4", "sensor.on_plate.from=1.4",
                                    "sensor.on_floor.from=1.4", "sensor.on_cylinder.from=1.4", rows + "]"});
}

/// How far the plate has come [m], on average over the last fifth of a second of 1.6 s.
double travel_under(const std::vector<LoadPoint>& load)
{
    auto s = pressed(load);
    run_until(s, 1.6);
    return result(s, "plate", "travel").value;
}

} // namespace

TEST_CASE("floor and cylinder carry what plate, load and bed weigh", "[piston][slow]")
{
    const double load = GENERATE(0.0, 100.0);
    auto s = pressed({{0.3, load}});
    run_until(s, 1.6);
    const double plate = s.model.pistons[0].mass * s.model.gravity.norm() + load;
    const double bed = weight_of_spheres(s);
    const double on_plate = result(s, "on_plate", "force_z").value;
    const double on_floor = -result(s, "on_floor", "force_z").value;
    const double on_cylinder = -result(s, "on_cylinder", "force_z").value;
    WARN("load " << load << " N: on the plate " << on_plate << " N of " << plate << " N; floor " << on_floor
                 << " N + cylinder " << on_cylinder << " N of " << plate + bed << " N");
    CHECK(on_plate == Approx(plate).epsilon(0.01));
    CHECK(on_floor + on_cylinder == Approx(plate + bed).epsilon(0.01));
    if (load > 0.0) CHECK(on_cylinder > 0.1 * load); // its friction takes a part (Janssen 1895)
}

TEST_CASE("a plate sinks further under more load, and does not come back all the way", "[piston][slow]")
{
    const double under_weight = travel_under({});
    double last = under_weight;
    for (const double load : {50.0, 100.0, 200.0}) {
        const double travel = travel_under({{0.3, load}});
        WARN(load << " N: " << 1e3 * (travel - under_weight) << " mm");
        CHECK(travel > last);
        last = travel;
    }
    const double unloaded = travel_under({{0.2, 200.0}, {0.45, 0.0}});
    WARN("200 N and back: " << 1e3 * (unloaded - under_weight) << " mm");
    CHECK(unloaded > under_weight);
    CHECK(unloaded < last);
}
