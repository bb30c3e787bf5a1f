// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/relaxation.hpp"

#include "io/scene/scene_file.hpp"
#include "scenarios/build/build_scene.hpp"
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

#include <random>

using talus::Simulation;
using talus::Vec3;

namespace
{

Simulation beads()
{
    const Workplace place;
    place.write("scene.toml", replaced(beads_in_a_box, "count = 8", "count = 30"));
    return talus::build_scene(talus::read_scene(place.path("scene.toml")).scene).simulation;
}

/// The beads thrown about in the box, through each other and through its walls.
Simulation beads_thrown_about()
{
    Simulation simulation = beads();
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> side(0.003, 0.047), height(0.003, 0.035);
    for (Vec3& x : simulation.state.position) x = Vec3(side(random), side(random), height(random));
    return simulation;
}

} // namespace

TEST_CASE("overlap at the start is undone, and only positions change", "[app][relaxation]")
{
    Simulation simulation = beads_thrown_about();
    simulation.state.motion[3].velocity = Vec3(1, 2, 3);
    const double d = simulation.model.mean_diameter;
    const auto overlaps = check_overlaps(simulation);
    REQUIRE(overlaps.worst > 0.3 * d);

    const auto relaxation = relax_overlaps(simulation, overlaps);
    CHECK(relaxation.steps > 10);
    CHECK(relaxation.left.worst < 2e-6 * d);
    CHECK(check_overlaps(simulation).worst == relaxation.left.worst);
    CHECK(simulation.state.motion[3].velocity == Vec3(1, 2, 3));
    CHECK(simulation.state.steps == 0);
    CHECK(simulation.state.time == 0.0);
    for (const Vec3& x : simulation.state.position)
        CHECK((x.z() > 0.0049 && x.x() > 0.0049 && x.x() < 0.0451)); // inside of the box
}

TEST_CASE("where there is no overlap nothing is done", "[app][relaxation]")
{
    Simulation simulation = beads();
    CHECK(relax_overlaps(simulation, check_overlaps(simulation)).steps == 0);
}

TEST_CASE("a run says how far the relaxation got", "[app][relaxation]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box, "--relax");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Catch::Matchers::Contains("relaxed in 0 steps: 0 overlaps"));
}
