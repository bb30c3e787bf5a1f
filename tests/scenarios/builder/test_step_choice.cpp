// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/law/impact.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/step_choice.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

TEST_CASE("the step is 0.0072 sqrt(d/g) of the smallest sphere where nothing is fast", "[step_choice]")
{
    auto scene = small_scene();
    scene.fill[0].diameter = {.distribution = "uniform", .min = 0.008, .max = 0.01};
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.time_step == Approx(0.0072 * std::sqrt(0.008 / 9.81)));
    CHECK_THAT(report.step, Contains("0.0072 sqrt(d/g)") && Contains("d = 8 mm"));
}

TEST_CASE("the fastest sphere moves a tenth of the smallest diameter in a step at most", "[step_choice]")
{
    auto scene = small_scene();
    SECTION("one that starts fast")
    {
        scene.fill[0].velocity = Vec3(0, 0, -30.0);
    }
    SECTION("one that is poured in fast")
    {
        scene.pour.push_back(small_pour());
        scene.pour[0].velocity = Vec3(30.0, 0, 0);
    }
    SECTION("one that spins fast")
    {
        scene.fill[0].angular_velocity = Vec3(0, 30.0 / 0.005, 0);
    }
    SECTION("one that falls far: 50 m")
    {
        scene.wall[0].max.z() = 50.0;
        scene.fill[0].region.min.z() = 49.9;
        scene.fill[0].region.max.z() = 50.0;
    }
    const auto [simulation, report, output] = build_scene(scene);
    const double step = simulation.model.time_step;
    CHECK(step < 0.0072 * std::sqrt(0.01 / 9.81));
    // 30 m/s and a fall through the box of at most 0.2 m; or v² = 2 g 50 m.
    const double fastest = 0.1 * 0.01 / step;
    CHECK(fastest >= 30.0);
    CHECK(fastest < std::sqrt(2 * 9.81 * 50.1) + 0.3);
    CHECK_THAT(report.step, Contains("moves 0.1 d"));
}

TEST_CASE("a sphere that leaves through an outlet falls until its upper face", "[step_choice]")
{
    auto scene = small_scene();
    scene.outlet = {{"below", box_region(Vec3(-1, -1, -2), Vec3(1, 1, -1))}};
    const auto simulation = build_scene(scene).simulation;
    // From the highest sphere of the fill, below 0.1 m, to -1 m.
    const double fall = 1.0 + 0.1;
    const auto choice = choose_step(scene, simulation);
    CHECK(choice.fastest_speed <= std::sqrt(2 * 9.81 * fall));
    CHECK(choice.fastest_speed > std::sqrt(2 * 9.81 * 1.0));
}

TEST_CASE("where nothing is to land on a sphere falls to the end of the world", "[step_choice]")
{
    auto scene = small_scene();
    SECTION("no walls")
    {
        scene.wall.clear();
    }
    SECTION("a slope that leads on downwards")
    {
        scene.wall[0].shape = "plane";
        scene.wall[0].normal = Vec3(1, 0, 1);
    }
    scene.world.min = Vec3(-10, -10, -10);
    const auto choice = choose_step(scene, build_scene(scene).simulation);
    CHECK(choice.fastest_speed > std::sqrt(2 * 9.81 * 10.0));
    CHECK(choice.fastest_speed < std::sqrt(2 * 9.81 * 10.11));
}

TEST_CASE("without gravity the speeds alone decide the step", "[step_choice]")
{
    auto scene = small_scene();
    scene.world.gravity.setZero();
    scene.fill[0].velocity = Vec3(2.0, 0, 0);
    CHECK(build_scene(scene).simulation.model.time_step == Approx(0.1 * 0.01 / 2.0));
}

TEST_CASE("a step that the scene gives is taken, and told beside the automatic one", "[step_choice]")
{
    auto scene = small_scene();
    scene.time.step = {1e-3, ""};
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.time_step == 1e-3);
    CHECK_THAT(report.step, Contains("1 ms") && Contains("given by the scene") && Contains("0.2299 ms"));
}

TEST_CASE("a given step needs neither gravity nor speeds", "[step_choice]")
{
    auto scene = small_scene();
    scene.world.gravity.setZero();
    scene.time.step = {1e-3, ""};
    CHECK(build_scene(scene).simulation.model.time_step == 1e-3);
}

TEST_CASE("the forecast tells the stiffness that the law has between two mean spheres", "[step_choice]")
{
    const auto [simulation, report, output] = build_scene(small_scene());
    const auto& model = simulation.model;
    // k = 4 Υ / (Σ h²) of the compliance Σ that a resting contact of this run gets.
    const double mass = 2500.0 * std::numbers::pi / 6.0 * 1e-6;
    const double compliance = spring_compliance<double>(model.materials.between(0, 0).stiffness, 2.0 / mass,
        {.h = model.time_step, .min_sweeps = static_cast<double>(model.solver.min_sweeps)});
    char stiffness[40];
    std::snprintf(
        stiffness, sizeof stiffness, "%.3g N/m", 4 * upsilon / (compliance * model.time_step * model.time_step));
    CHECK_THAT(report.overlap, Contains(stiffness));
    // mean overlap/d = 0.4 Z g h² / (N_min d) with h² = 0.0072² d/g: 1.04e-5 Z.
    CHECK_THAT(report.overlap, Contains("1e-05 Z d"));
}

TEST_CASE("a material softer than the step allows decides the stiffness of the forecast", "[step_choice]")
{
    auto scene = small_scene();
    scene.contact[0].stiffness = 123.0;
    CHECK_THAT(build_scene(scene).report.overlap, Contains("at most 123 N/m"));
}

TEST_CASE("rigid contacts are forecast to be rigid", "[step_choice]")
{
    auto scene = small_scene();
    scene.solver.stabilisation = "projected";
    CHECK_THAT(build_scene(scene).report.overlap, Contains("rigid"));
}

TEST_CASE("a piston may fall all across the scene before its speed counts as a blow-up", "[step_choice]")
{
    auto scene = small_scene();
    const double without = choose_step(scene, build_scene(scene).simulation).speed_limit;
    auto& plate = scene.wall.emplace_back();
    plate.name = "plate";
    plate.shape = "disk";
    plate.material = "glass";
    plate.center = Vec3(0.025, 0.025, 0.15);
    plate.radius = 0.02;
    plate.mass = 2.0;
    plate.guide = Vec3(0, 0, -1);
    plate.load = {{0.0, 0.0}, {1.0, 1e6}};
    const auto choice = choose_step(scene, build_scene(scene).simulation);
    const double across = 0.2; // the box
    CHECK(choice.speed_limit - without == Approx(10.0 * std::sqrt(2.0 * (9.81 + 1e6 / 2.0) * across)));
    // The step is that of the spheres: where the plate is too fast for it, steps are split.
    CHECK(choice.step == choice.by_gravity);
}

TEST_CASE("without gravity the load of a piston decides the step where nothing else moves", "[step_choice]")
{
    auto scene = small_scene();
    scene.world.gravity.setZero();
    scene.wall[0].mass = 1.0;
    scene.wall[0].guide = Vec3::UnitX();
    scene.wall[0].load = {{0.0, 30.0}};
    const double across = 0.05; // the box
    CHECK(build_scene(scene).simulation.model.time_step == Approx(0.1 * 0.01 / std::sqrt(2.0 * 30.0 * across)));
}

TEST_CASE("a wall that moves adds the speed of its fastest point to that of the fastest sphere", "[step_choice]")
{
    auto scene = small_scene();
    scene.time.duration = 1.0;
    const double still = choose_step(scene, build_scene(scene).simulation).fastest_speed;
    auto& motion = scene.wall[0].motion.emplace_back();
    double expected = 0.0;
    SECTION("one that is pushed")
    {
        motion.kind = "translate";
        motion.velocity = Vec3(3.0, -4.0, 0);
        expected = 5.0;
    }
    SECTION("one that is pushed for a while")
    {
        motion.kind = "translate";
        motion.velocity = Vec3(0, 2.0, 0);
        motion.from = 0.4;
        motion.to = 0.6;
        expected = 2.0;
    }
    SECTION("one that turns about an edge: the opposite one is fastest")
    {
        motion.kind = "turn";
        motion.axis = Vec3::UnitZ();
        motion.rate = 30.0;
        expected = 30.0 * std::hypot(0.05, 0.05);
    }
    SECTION("one that is shaken")
    {
        motion.kind = "shake";
        motion.amplitude = Vec3(0, 0.01, 0);
        motion.frequency = 37.0;
        expected = 0.01 * 2.0 * std::numbers::pi * 37.0;
    }
    SECTION("one that is shaken in time with any even sampling")
    {
        motion.kind = "shake";
        motion.amplitude = Vec3(0, 0.001, 0);
        motion.frequency = 1000.0;
        motion.from = 0.00025;
        expected = 0.001 * 2.0 * std::numbers::pi * 1000.0;
    }
    SECTION("one that is knocked for a ten-thousandth of the run")
    {
        motion.kind = "table";
        motion.table = {{0.50005, Vec3::Zero()}, {0.50015, Vec3(0.0004, 0, 0)}};
        expected = 4.0;
    }
    SECTION("one that follows a table")
    {
        motion.kind = "table";
        motion.table = {{0.1, Vec3::Zero()}, {0.2, Vec3(0.3, 0, 0)}, {0.9, Vec3::Zero()}};
        expected = 3.0;
    }
    SECTION("one that is pushed first and turned later: never both")
    {
        motion.kind = "translate";
        motion.velocity = Vec3(0, 0, 2.0);
        motion.to = 0.1;
        auto& later = scene.wall[0].motion.emplace_back();
        later.kind = "turn";
        later.axis = Vec3::UnitZ();
        later.rate = 0.001;
        later.from = 0.2;
        expected = 2.0;
    }
    SECTION("one that is shaken on an arm that turns: the faster of both")
    {
        motion.kind = "shake";
        motion.amplitude = Vec3(0.02, 0, 0);
        motion.frequency = 10.0;
        auto& turn = scene.wall[0].motion.emplace_back();
        turn.kind = "turn";
        turn.axis = Vec3::UnitZ();
        turn.rate = 30.0;
        expected = 30.0 * std::hypot(0.05, 0.05);
    }
    SECTION("a plane that turns: where spheres are, not at its end")
    {
        scene.wall.resize(2);
        scene.wall[1] = scene.wall[0];
        scene.wall[1].name = "flap";
        scene.wall[1].shape = "plane";
        scene.wall[1].normal = Vec3(0, 0, 1);
        scene.wall[0].motion.clear();
        auto& turn = scene.wall[1].motion[0];
        turn.kind = "turn";
        turn.point = Vec3::Zero();
        turn.axis = Vec3::UnitZ();
        turn.rate = 30.0;
        Box spheres;
        for (const Vec3& x : build_scene(scene).simulation.state.position) spheres.extend(x);
        expected = 30.0 * std::hypot(spheres.max.x(), spheres.max.y());
    }
    CHECK(choose_step(scene, build_scene(scene).simulation).fastest_speed - still == Approx(expected));
}

TEST_CASE("a moving wall's speed, and so the step, does not depend on when the run ends", "[step_choice]")
{
    auto scene = small_scene();
    scene.time.duration = 0.0123;
    auto& motion = scene.wall[0].motion.emplace_back();
    SECTION("shaken")
    {
        motion.kind = "shake";
        motion.amplitude = Vec3(0, 0, 0.03);
        motion.frequency = 37.0;
    }
    SECTION("turned")
    {
        motion.kind = "turn";
        motion.axis = Vec3(1, 2, 3).normalized();
        motion.rate = 77.0;
    }
    SECTION("sunk")
    {
        motion.kind = "translate";
        motion.velocity = Vec3(0, 0, -4.0);
    }
    SECTION("knocked after the end of the shorter run")
    {
        motion.kind = "table";
        motion.table = {{0.5, Vec3::Zero()}, {0.5001, Vec3(0.0004, 0, 0)}};
    }
    const auto early = choose_step(scene, build_scene(scene).simulation);
    scene.time.duration = 10.0;
    const auto late = choose_step(scene, build_scene(scene).simulation);
    CHECK(late.step == early.step);
    CHECK(early.step < 0.0072 * std::sqrt(0.01 / 9.81)); // the speed decides
}

TEST_CASE("a step of more than ten times the automatic one is warned of, one longer than the run is refused",
    "[step_choice][errors]")
{
    auto scene = small_scene();
    const double automatic = 0.0072 * std::sqrt(0.01 / 9.81);
    scene.time.step = {9.9 * automatic, ""};
    CHECK(build_scene(scene).report.warnings.empty());
    scene.time.step = {10.1 * automatic, ""};
    const auto warnings = build_scene(scene).report.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("2.322 ms") && Contains("10.1 times the automatic one"));
    scene.time.step = {1.01 * scene.time.duration, ""};
    CHECK_THROWS_WITH(build_scene(scene), "the step is longer than the run, 'duration'");
}

TEST_CASE("a tight lattice that cannot turn is warned of", "[step_choice]")
{
    auto scene = small_scene();
    const auto warnings = [&] { return build_scene(scene).report.warnings.size(); };
    CHECK(warnings() == 0);
    scene.world.rotation = false;
    CHECK(warnings() == 1);
    scene.contact[0].friction = 0.0;
    CHECK(warnings() == 0);
}
