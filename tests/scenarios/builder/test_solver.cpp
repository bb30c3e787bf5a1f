// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/solver.hpp"
#include "tests/scenarios/measured_settings.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace
{

/// As many rigid beads as lie `depth` deep in a narrow tube.
scene::Scene tube(double depth)
{
    auto scene = small_scene();
    scene.solver.stabilisation = "projected";
    scene.wall[0].max = Vec3(0.04, 0.04, 10.0);
    scene.fill[0].region.min = Vec3(0.001, 0.001, 0.001);
    scene.fill[0].region.max = Vec3(0.039, 0.039, 9.0);
    scene.fill[0].diameter.value = 0.01;
    // Three beads stand 1.1 diameters apart across the room, which is packed to 0.6.
    scene.fill[0].count = static_cast<std::int64_t>(depth * 0.01 * 0.032 * 0.032 * 0.6 / 5.236e-7);
    return scene;
}

/// The small scene in a wide box, with one large sphere besides.
scene::Scene with_large(double diameter)
{
    auto scene = small_scene();
    scene.wall[0].max = Vec3(0.5, 0.5, 1.0);
    scene.fill.push_back(scene.fill[0]);
    scene.fill[1].region = box_region(Vec3(0.01, 0.01, 0.15), Vec3(0.49, 0.49, 0.9));
    scene.fill[1].count = 1;
    scene.fill[1].diameter.value = diameter;
    return scene;
}

SolverSettings solver_of(const scene::Scene& scene)
{
    return build_scene(scene).simulation.model.solver;
}

} // namespace

TEST_CASE("pressures are scaled in rigid beds of forty grains and more", "[scaling_choice]")
{
    CHECK_FALSE(solver_of(tube(36)).pressure_scaling);
    CHECK(solver_of(tube(44)).pressure_scaling);

    auto soft = tube(44);
    soft.solver.stabilisation = "matched";
    CHECK_FALSE(solver_of(soft).pressure_scaling);

    auto periodic = tube(44);
    periodic.world.periodic = {"x"};
    periodic.world.min = Vec3::Zero();
    periodic.world.max = Vec3(0.04, 0.04, 10.0);
    CHECK_FALSE(solver_of(periodic).pressure_scaling);
}

TEST_CASE("pressures are scaled under what is ten times as heavy", "[scaling_choice]")
{
    const auto with_large = [](double diameter) {
        auto scene = tube(2);
        scene.fill.push_back(scene.fill[0]);
        scene.fill[0].region.max.z() = 1.0;
        scene.fill[1].region.min.z() = 1.0;
        scene.fill[1].count = 1;
        scene.fill[1].diameter.value = diameter;
        return solver_of(scene).pressure_scaling;
    };
    CHECK_FALSE(with_large(0.021)); // 9.3 times
    CHECK(with_large(0.022));       // 10.6 times
}

TEST_CASE("whether pressures are scaled is as the scene says, if it does", "[scaling_choice]")
{
    auto shallow = tube(36), deep = tube(44);
    shallow.solver.pressure_scaling = {true, ""};
    deep.solver.pressure_scaling = {false, ""};
    CHECK(solver_of(shallow).pressure_scaling);
    CHECK_FALSE(solver_of(deep).pressure_scaling);
}

TEST_CASE("six sweeps go with scaling in beds of a hundred grains and more", "[scaling_choice]")
{
    CHECK(solver_of(tube(90)).min_sweeps == 3);
    auto deep = tube(110);
    CHECK(solver_of(deep).min_sweeps == 6);
    SECTION("not more than the scene allows")
    {
        deep.solver.max_sweeps = 5;
        CHECK(solver_of(deep).min_sweeps == 5);
    }
    SECTION("not where the scene says how many")
    {
        deep.solver.min_sweeps = 4;
        CHECK(solver_of(deep).min_sweeps == 4);
    }
    SECTION("not without scaling")
    {
        deep.solver.pressure_scaling = {false, ""};
        CHECK(solver_of(deep).min_sweeps == 3);
    }
}

TEST_CASE("contacts of tall columns are rigid where nothing flows", "[solver_choice]")
{
    const auto open_tube = [](double depth) {
        auto scene = tube(depth);
        scene.solver.stabilisation = "auto";
        return scene;
    };
    CHECK(solver_of(open_tube(140)).stabilisation == Stabilisation::matched);
    auto tall = open_tube(160);
    const auto [simulation, report, output] = build_scene(tall);
    CHECK(simulation.model.solver.stabilisation == Stabilisation::projected);
    CHECK(simulation.model.solver.pressure_scaling);
    CHECK(simulation.model.solver.min_sweeps == 6);
    CHECK_THAT(report.solver, Contains("stabilisation projected and tolerance 0.01"));

    // Not so where a stiffness is given, spheres come in, or the scene says what it wants.
    const int change = GENERATE(range(0, 5));
    if (change == 0) tall.contact[0].stiffness = 1e4;
    if (change == 1) tall.pour.push_back(small_pour());
    tall.measured = test::measured_settings();
    if (change == 2) tall.accuracy = "2%";
    if (change == 3) tall.solver.pressure_scaling = {false, ""};
    if (change == 4) tall.solver.stabilisation = "matched";
    CHECK(solver_of(tall).stabilisation == Stabilisation::matched);
}

TEST_CASE("contacts are rigid under a sphere that would press grains through the floor", "[solver_choice]")
{
    CHECK(solver_of(with_large(0.368)).stabilisation == Stabilisation::matched); // 49 836 times
    const auto scene = with_large(0.369);                                        // 50 243 times
    CHECK(solver_of(scene).stabilisation == Stabilisation::projected);
    CHECK(solver_of(scene).min_sweeps == 3);
    CHECK(solver_of(scene).tolerance == 1e-3);
    CHECK(solver_of(scene).pressure_scaling);
}

TEST_CASE("the step goes with the sixth root of a mass ratio, and with the sweeps", "[solver_choice][step_choice]")
{
    // What lies below a sphere of diameter D overlaps with D/d h², by 0.02 d where it has 800 times the mass.
    const auto step_under = [](double diameter) {
        const auto scene = with_large(diameter);
        const Simulation simulation = build_scene(scene).simulation;
        const StepChoice choice = choose_step(scene, simulation, measure_bed(simulation));
        CHECK(choice.step <= choice.by_heavy);
        return choice.by_heavy / std::sqrt(choice.min_sweeps);
    };
    const double ratio = 1000.0; // 0.1 m by 0.01 m
    CHECK(step_under(0.1) ==
          Approx(0.0072 * std::sqrt(0.01 / 9.81) * std::pow(800.0 / ratio, 1.0 / 6.0) / std::sqrt(2.0)));
    CHECK(step_under(0.3) == Approx(step_under(0.15) / std::sqrt(2.0)));
}

TEST_CASE("the tolerance goes with the inverse of a mass ratio beyond five, down to fine", "[solver_choice]")
{
    CHECK(solver_of(with_large(0.017)).tolerance == 1e-2); // 4.9 times
    CHECK(solver_of(with_large(0.02)).tolerance == Approx(1e-2 * 5.0 / 8.0));
    CHECK(solver_of(with_large(0.03)).tolerance == Approx(1e-2 * 5.0 / 27.0));
    auto scene = with_large(0.08); // 512 times
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.solver.tolerance == 1e-3);
    CHECK(report.solver ==
          "stabilisation matched and tolerance 0.001, for the heaviest sphere is 512 times the lightest");

    SECTION("not where the scene gives one")
    {
        scene.solver.tolerance = {0.02, ""};
        CHECK(solver_of(scene).tolerance == 0.02);
    }
    SECTION("so does that of an accuracy")
    {
        auto less = with_large(0.02); // 8 times
        less.measured = test::measured_settings();
        less.accuracy = "2%";
        CHECK(solver_of(less).tolerance == Approx(5e-3 * 5.0 / 8.0));
    }
    SECTION("not without gravity, where nothing rests on anything")
    {
        scene.world.gravity.setZero();
        scene.time.step = {1e-4, ""};
        CHECK(solver_of(scene).tolerance == 1e-2);
    }
}

TEST_CASE("overlap is undone with a speed that goes with the mean diameter", "[solver]")
{
    auto scene = small_scene();
    scene.fill[0].diameter = {.distribution = "uniform", .min = 0.004, .max = 0.01};
    CHECK(solver_of(scene).push_out_speed == Approx(0.1 * std::sqrt(0.007 * 9.81)));
    scene.world.gravity.setZero();
    scene.fill[0].velocity = Vec3(1, 0, 0);
    const Model model = build_scene(scene).simulation.model;
    CHECK(model.solver.push_out_speed == Approx(0.00072 * 0.007 / model.time_step));
}

TEST_CASE("a wall of finite mass is held until it is released", "[solver]")
{
    auto scene = small_scene();
    scene.wall.push_back(scene.wall[0]);
    scene.wall[1].name = "lid";
    scene.wall[1].min = Vec3(0, 0, 0.5);
    scene.wall[1].max = Vec3(0.1, 0.1, 0.6);
    scene.wall[1].mass = 2.0;
    scene.wall[1].guide = -Vec3::UnitZ();
    scene.wall[1].released_at = 0.25;
    const auto simulation = build_scene(scene).simulation;
    REQUIRE(simulation.model.pistons.size() == 1);
    CHECK_FALSE(simulation.model.pistons[0].is_free(0.2));
    CHECK(simulation.model.pistons[0].is_free(0.3));
}
