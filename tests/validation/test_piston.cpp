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

/// The scene with fewer spheres, held at this load once it has risen to it.
Simulation pressed(double load, const std::string& more = "solver.tolerance=standard")
{
    char rows[100];
    std::snprintf(rows, sizeof rows, "wall.plate.load=[[0.65, -17], [0.75, 0], [1.0, %g]]", load);
    return open_scene("piston", {"fill.0.count=1500", "wall.plate.center=[0, 0, 0.1]", "wall.plate.released_at=0.35",
                                    "fill.0.region.height=0.095", "sensor.plate.from=1.1", "sensor.on_plate.from=1.1",
                                    "sensor.on_floor.from=1.1", "sensor.on_cylinder.from=1.1", rows, more});
}

} // namespace

TEST_CASE("floor and cylinder carry what plate, load and bed weigh", "[piston][slow]")
{
    const double load = GENERATE(0.0, 100.0);
    auto s = pressed(load);
    run_until(s, 1.3);
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
    double last = 0.0, before_load = 0.0;
    for (const double load : {0.0, 50.0, 100.0, 200.0}) {
        auto s = pressed(load);
        run_until(s, 1.3);
        const double travel = result(s, "plate", "travel").value;
        WARN(load << " N: " << 1e3 * travel << " mm");
        CHECK(travel > last);
        if (load == 0.0) before_load = travel;
        last = travel;
    }
    auto s = pressed(0.0, "wall.plate.load=[[0.65, -17], [0.75, 0], [0.9, 200], [1.0, 0]]");
    run_until(s, 1.3);
    const double travel = result(s, "plate", "travel").value;
    WARN("200 N and back: " << 1e3 * travel << " mm");
    CHECK(travel > before_load);
    CHECK(travel < last);
}
