// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/law/impact.hpp"
#include "core/law/thresholds.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/step_choice.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace
{

StepChoice choice_of(const scene::Scene& scene)
{
    const Simulation simulation = build_scene(scene).simulation;
    return choose_step(scene, simulation, measure_bed(simulation));
}

double closing_speed(const scene::Scene& scene)
{
    return choice_of(scene).closing_speed;
}

/// The small scene, in which nothing moves but for its beads, with one more wall.
scene::WallTable& add_wall(scene::Scene& scene, const char* shape)
{
    auto& wall = scene.wall.emplace_back();
    wall.name = "mover";
    wall.shape = shape;
    wall.material = "glass";
    return wall;
}

/// A wall that moves as the scene begins.
scene::MotionTable& add_motion(scene::WallTable& wall, const char* kind)
{
    auto& motion = wall.motion.emplace_back();
    motion.kind = kind;
    return motion;
}

} // namespace

TEST_CASE("the automatic step is the longest that keeps to all targets", "[step_choice]")
{
    auto scene = small_scene();
    scene.fill[0].diameter = {.distribution = "uniform", .min = 0.008, .max = 0.01};
    scene.wall[0].max.z() = 1.0;
    scene.fill[0].region.min.z() += 0.8;
    scene.fill[0].region.max.z() += 0.8;
    const auto [simulation, report, output] = build_scene(scene);
    const StepChoice choice = choose_step(scene, simulation, measure_bed(simulation));
    CHECK(simulation.model.time_step == choice.automatic());
    CHECK(simulation.model.solver.min_sweeps == choice.min_sweeps);
    const double h = choice.step;
    for (const double target : {choice.by_overlap, choice.by_creep, choice.by_approach, choice.by_heavy})
        CHECK(h <= target);
    CHECK((h == choice.by_overlap || h == choice.by_creep || h == choice.by_approach || h == choice.by_heavy));
    CHECK(h == choice.by_approach); // they fall 0.8 m
    CHECK(choice.by_creep == Approx(choice.min_sweeps * 0.0036 * std::sqrt(0.008 / 9.81)));
    CHECK(h > (choice.min_sweeps - 1) * 0.0036 * std::sqrt(0.008 / 9.81)); // fewer sweeps would not do
    CHECK(h * (1.0 + choice.restitution) * choice.closing_speed == Approx(0.1 * 0.008));
    CHECK_THAT(report.step, Contains("approach of what closes at") && Contains("d = 8 mm"));
}

TEST_CASE("what sticks to spheres or to walls alone shortens the step", "[step_choice]")
{
    auto scene = small_scene();
    scene.solver.stabilisation = GENERATE(as<std::string>{}, "matched", "projected");
    scene.materials.push_back({"steel", 7800.0});
    scene.contact.push_back({{"glass", "steel"}});
    scene.wall[0].material = "steel";
    const StepChoice loose = choice_of(scene);
    CHECK(loose.by_attraction == infinity);
    const std::size_t which = GENERATE(0, 1); // glass on glass, glass on steel
    const double d = 0.01, weights = 1e4;
    scene.contact[which].cohesion = {.law = "bond_number", .bond_number = weights};
    const StepChoice sticky = choice_of(scene);
    // What draws a pair of equal spheres together makes 2 F/m, a sphere to a wall F/m.
    CHECK(sticky.by_attraction == Approx(std::sqrt(0.1 * d / ((which == 0 ? 2.0 : 1.0) * weights * 9.81))));
    CHECK(sticky.automatic() < 0.5 * loose.automatic());
    if (scene.solver.stabilisation == "projected") return;
    const double h = sticky.automatic(), acceleration = (which == 0 ? 2.0 : 1.0) * weights * 9.81;
    CHECK(sigma_per_sweep / sticky.min_sweeps * acceleration * h * h / (4.0 * upsilon) <= 0.002 * d); // its overlap
}

TEST_CASE("targets that the scene gives are kept", "[step_choice]")
{
    auto scene = small_scene();
    const StepChoice usual = choice_of(scene);
    SECTION("approach")
    {
        scene.targets.approach = {0.01, ""};
        CHECK(build_scene(scene).simulation.model.time_step ==
              Approx(0.01 * 0.01 / ((1.0 + usual.restitution) * usual.closing_speed)));
    }
    SECTION("creep")
    {
        scene.targets.creep = {0.0006, ""};
        CHECK(build_scene(scene).simulation.model.time_step == Approx(4 * 0.0006 * std::sqrt(0.01 / 9.81)));
    }
    SECTION("overlap, which falls with the square of the step, and with the sweeps")
    {
        scene.targets.overlap = {1e-5, ""};
        const auto [simulation, report, output] = build_scene(scene);
        const double h = simulation.model.time_step, depth = measure_bed(simulation).borne_depth();
        CHECK(0.6 * 9.81 * depth * h * h / simulation.model.solver.min_sweeps == Approx(1e-5 * 0.01));
        CHECK_THAT(report.step, Contains("for the mean overlap of the bed"));
    }
}

TEST_CASE("a softness that the scene gives is no overlap of the step", "[step_choice]")
{
    auto scene = small_scene();
    const double rigid = choice_of(scene).by_overlap;
    scene.contact[0].stiffness = 100.0;
    // Where the law would be softer than that, only what is beyond counts.
    CHECK(choice_of(scene).by_overlap > 2.0 * rigid);
}

TEST_CASE("overlap that the modulus of a material makes is no overlap of the step", "[step_choice][elasticity]")
{
    auto scene = small_scene();
    const double rigid = choice_of(scene).by_overlap;
    double before = rigid;
    for (const double modulus : {1e12, 1e7, 1e5, 1e4}) {
        scene.materials[0].young_modulus = modulus;
        const double now = choice_of(scene).by_overlap;
        CHECK(now >= before);
        before = now;
    }
    CHECK(before > 2.0 * rigid);
}

TEST_CASE("two materials have the modulus of Hertz's contact, unless a stiffness is given", "[step_choice][elasticity]")
{
    auto scene = small_scene();
    CHECK_FALSE(build_scene(scene).simulation.model.physics.elasticity);
    scene.materials[0].young_modulus = 1e7;
    scene.materials[0].poisson = 0.5;
    CHECK(build_scene(scene).simulation.model.materials.between(0, 0).modulus == Approx(0.5 * 1e7 / 0.75));
    CHECK(build_scene(scene).simulation.model.physics.elasticity);

    scene.materials.push_back({"steel", 7800.0, 2e7, 0.0});
    scene.contact.push_back({.between = {"glass", "steel"}});
    CHECK(
        build_scene(scene).simulation.model.materials.between(0, 1).modulus == Approx(1.0 / (0.75 / 1e7 + 1.0 / 2e7)));
    scene.materials[1].young_modulus = infinity;
    CHECK(build_scene(scene).simulation.model.materials.between(1, 0).modulus == Approx(1e7 / 0.75));

    scene.contact[0].stiffness = 1e4;
    CHECK(build_scene(scene).simulation.model.materials.between(0, 0).modulus == infinity);
}

TEST_CASE("the forecast says whether a bed is as soft as its materials", "[step_choice][elasticity]")
{
    auto scene = small_scene();
    scene.materials[0].young_modulus = 70e9;
    CHECK_THAT(build_scene(scene).report.overlap, Contains("softer than the materials: sweeps carry no more"));
    scene.materials[0].young_modulus = 1e4;
    CHECK_THAT(build_scene(scene).report.overlap, Contains("as soft as the materials"));
}

TEST_CASE("sweeps go with the step that a scene gives", "[step_choice]")
{
    auto scene = small_scene();
    const double two = 2 * 0.0036 * std::sqrt(0.01 / 9.81);
    for (const auto& [step, sweeps] : {std::pair(0.1, 2), {0.99, 2}, {1.01, 3}, {1.51, 4}, {9.0, 4}}) {
        scene.time.step = {step * two, ""};
        CHECK(build_scene(scene).simulation.model.solver.min_sweeps == sweeps);
    }
    scene.solver.min_sweeps = 5;
    CHECK(build_scene(scene).simulation.model.solver.min_sweeps == 5);
    scene.solver.min_sweeps = 0;
    scene.solver.max_sweeps = 3;
    CHECK(build_scene(scene).simulation.model.solver.min_sweeps == 3);
    scene.solver.stabilisation = "projected"; // rigid contacts need no more
    CHECK(build_scene(scene).simulation.model.solver.min_sweeps == 3);
}

TEST_CASE("what starts fast against others or a wall closes", "[step_choice]")
{
    auto scene = small_scene();
    const double still = closing_speed(scene);
    SECTION("all of a fill, against the box")
    {
        scene.fill[0].velocity = Vec3(0, 0, -30.0);
    }
    SECTION("a fill against another")
    {
        scene.wall.resize(1);
        scene.wall[0] = {};
        auto& floor = scene.wall[0];
        floor.name = "floor";
        floor.shape = "plane";
        floor.material = "glass";
        scene.fill.push_back(scene.fill[0]);
        scene.fill[1].region.min.z() += 1.0;
        scene.fill[1].region.max.z() += 1.0;
        scene.fill[0].velocity = Vec3(30.0, 0, 0);
        scene.fill[1].velocity = Vec3(-30.0, 0, 0);
    }
    SECTION("what is poured in")
    {
        scene.pour.push_back(small_pour());
        scene.pour[0].velocity = Vec3(30.0, 0, 0);
    }
    CHECK(closing_speed(scene) >= 28.0); // of twenty-one, one differs from the mean by less than 30 m/s
    CHECK(closing_speed(scene) <= 30.0 + 2.0 * still + 5.0);
    CHECK(still < 2.0);
}

TEST_CASE("what is fast side by side, along walls or on the spot does not close", "[step_choice]")
{
    auto scene = small_scene();
    scene.wall.clear();
    add_wall(scene, "plane");
    const double still = closing_speed(scene);
    SECTION("a bed that slides along its floor")
    {
        scene.fill[0].velocity = Vec3(30.0, 0, 0);
    }
    SECTION("spheres that spin")
    {
        scene.fill[0].angular_velocity = Vec3(0, 30.0 / 0.005, 0);
    }
    SECTION("a belt")
    {
        add_motion(scene.wall[0], "translate").velocity = Vec3(0, 30.0, 0);
        scene.fill[0].velocity = Vec3::Zero();
    }
    SECTION("a roller, a disk and a funnel that turn about their own axes, and one far away")
    {
        for (const char* shape : {"cylinder", "cone", "disk", "disk"}) {
            auto& wall = add_wall(scene, shape);
            wall.name = "roller" + std::to_string(scene.wall.size());
            wall.base = wall.center = Vec3(0.1, 0.2, 0.01);
            wall.radius = wall.base_radius = 0.05;
            wall.top_radius = 0.02;
            wall.height = 0.1;
            wall.axis = wall.normal = Vec3(3, 0, 4) / 5.0;
            auto& motion = add_motion(wall, "turn");
            motion.point = wall.base;
            motion.axis = wall.axis;
            motion.rate = 600.0;
        }
        scene.wall.back().center.x() += 20.0;
        scene.wall.back().motion[0].point.x() += 20.0;
        CHECK(closing_speed(scene) == Approx(still).margin(0.5)); // they stand lower or not than the floor
        return;
    }
    CHECK(closing_speed(scene) == Approx(still));
}

TEST_CASE("a scene seen from a moving frame has the same step", "[step_choice]")
{
    auto scene = small_scene();
    const StepChoice still = choice_of(scene);
    const Vec3 frame(3.0, -4.0, 0.5);
    scene.fill[0].velocity += frame;
    for (auto& wall : scene.wall) add_motion(wall, "translate").velocity = frame;
    const StepChoice moving = choice_of(scene);
    CHECK(moving.closing_speed == Approx(still.closing_speed));
    CHECK(moving.step == Approx(still.step));
}

TEST_CASE("a fall counts until something lands", "[step_choice]")
{
    auto scene = small_scene();
    SECTION("from 50 m")
    {
        scene.wall[0].max.z() = 50.0;
        scene.fill[0].region.min.z() = 49.9;
        scene.fill[0].region.max.z() = 50.0;
        CHECK(closing_speed(scene) == Approx(std::sqrt(2 * 9.81 * 50.0)).epsilon(0.01));
    }
    SECTION("an outlet further down is no landing")
    {
        const double before = closing_speed(scene);
        scene.outlet = {{"below", box_region(Vec3(-1, -1, -2), Vec3(1, 1, -1))}};
        CHECK(closing_speed(scene) == before);
    }
    SECTION("nor is the end of the world")
    {
        scene.wall.clear();
        scene.world.min = Vec3(-10, -10, -10);
        CHECK(closing_speed(scene) == 0.0);
        CHECK(choice_of(scene).speed_limit > 10.0 * std::sqrt(2 * 9.81 * 10.0));
    }
    SECTION("on a slope, at its lowest below the spheres")
    {
        scene.wall[0] = {};
        auto& slope = scene.wall[0];
        slope.name = "slope";
        slope.shape = "plane";
        slope.material = "glass";
        slope.point = Vec3(0, 0, -1.0);
        slope.normal = Vec3(1, 0, 1) / std::sqrt(2.0);
        const double speed = closing_speed(scene);
        CHECK(speed > std::sqrt(2 * 9.81 * 1.0));
        CHECK(speed < std::sqrt(2 * 9.81 * 1.2));
    }
    SECTION("what lies on what came before falls less: a bed as high as the room that it fills")
    {
        scene.fill[0].count = 75;
        const Simulation simulation = build_scene(scene).simulation;
        double highest = 0.0;
        for (const Vec3& x : simulation.state.position) highest = std::max(highest, x.z() + 0.005);
        CHECK(measure_bed(simulation).landing < highest - 0.02);
    }
}

TEST_CASE("without gravity the speeds alone decide the step, and what is thrown back meets what comes", "[step_choice]")
{
    auto scene = small_scene();
    scene.world.gravity.setZero();
    scene.fill[0].velocity = Vec3(2.0, 0, 0);
    const double e = GENERATE(0.0, 0.5, 1.0); // the greatest counts
    for (auto& law : scene.contact) law.restitution = 0.0;
    scene.contact.back().restitution = e;
    CHECK(build_scene(scene).simulation.model.time_step == Approx(0.1 * 0.01 / ((1.0 + e) * 2.0)));
    CHECK(build_scene(scene).simulation.model.solver.min_sweeps == 2);
}

TEST_CASE("what hardly closes has a step no longer than the time between samples", "[step_choice]")
{
    auto scene = small_scene();
    scene.world.gravity.setZero();
    scene.fill[0].velocity = Vec3(1e-6, 0, 0);
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.time_step == scene.time.metrics_interval);
    CHECK_THAT(report.step, Contains("for the time between samples"));
}

TEST_CASE("walls that rub carry what lies deeper than they are apart", "[step_choice]")
{
    auto scene = small_scene();
    scene.wall[0].max.z() = 5.0;
    scene.contact[0].friction = 0.4;
    scene.fill[0].count = 2000;
    scene.fill[0].region.max.z() = 4.9;
    const Bed rough = measure_bed(build_scene(scene).simulation);
    REQUIRE(rough.measures.depth > 60.0);
    // The lattice of the fill is up to two beads narrower than the box.
    const double widest = 0.05 / (4 * 0.5 * 0.4) / 0.01;
    CHECK(rough.screening_length <= widest);
    CHECK(rough.screening_length >= 0.6 * widest);
    CHECK(rough.borne_depth() < 2.0 * rough.screening_length);
    // Twice the mean of Λ (1 − exp(−z/Λ)), by the trapezium rule.
    double sum = 0.0;
    const int parts = 2000;
    for (int k = 0; k <= parts; ++k) {
        const double z = rough.measures.depth * k / parts;
        sum += (k == 0 || k == parts ? 0.5 : 1.0) * (1.0 - std::exp(-z / rough.screening_length));
    }
    CHECK(rough.borne_depth() == Approx(2.0 * rough.screening_length * sum / parts).epsilon(1e-5));
    scene.contact[0].friction = 0.0;
    const Bed smooth = measure_bed(build_scene(scene).simulation);
    CHECK(smooth.borne_depth() == smooth.measures.depth);
}

TEST_CASE("a step that the scene gives is taken, and told beside the automatic one", "[step_choice]")
{
    auto scene = small_scene();
    scene.time.step = {1e-3, ""};
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.time_step == 1e-3);
    CHECK_THAT(report.step, Contains("1 ms") && Contains("given by the scene") && Contains("auto would be 0."));
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
    const double h = model.time_step;
    char overlap[40];
    std::snprintf(
        overlap, sizeof overlap, "by %.2g Z on average", 0.45 * 9.81 * h * h / (0.01 * model.solver.min_sweeps));
    CHECK_THAT(report.overlap, Contains(overlap));
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
    const StepChoice without = choice_of(scene);
    auto& plate = add_wall(scene, "disk");
    plate.center = Vec3(0.025, 0.025, 0.15);
    plate.radius = 0.02;
    plate.mass = 2.0;
    plate.guide = Vec3(0, 0, -1);
    plate.load = {{0.0, 0.0}, {1.0, 1e6}};
    const StepChoice choice = choice_of(scene);
    const double across = 0.2; // the box
    const double more = choice.speed_limit - 0.01 / choice.step - (without.speed_limit - 0.01 / without.step);
    CHECK(more == Approx(10.0 * std::sqrt(2.0 * (9.81 + 1e6 / 2.0) * across)));
    // The step is that of the spheres: where the plate is too fast for it, steps are split.
    CHECK(choice.closing_speed == without.closing_speed);
    CHECK(choice.by_overlap < 0.1 * without.by_overlap); // what it presses overlaps
}

TEST_CASE("without gravity the load of a piston decides the step where nothing else moves", "[step_choice]")
{
    auto scene = small_scene();
    scene.world.gravity.setZero();
    scene.wall[0].mass = 1.0;
    scene.wall[0].guide = Vec3::UnitX();
    scene.wall[0].load = {{0.0, 30.0}};
    const double across = 0.05; // the box
    const StepChoice choice = choice_of(scene);
    CHECK((1.0 + choice.restitution) * choice.by_approach == Approx(0.1 * 0.01 / std::sqrt(2.0 * 30.0 * across)));
}

TEST_CASE("a wall that moves along its normal adds its speed", "[step_choice]")
{
    auto scene = small_scene();
    scene.time.duration = 1.0;
    const double still = closing_speed(scene);
    auto& box = scene.wall[0];
    double expected = 0.0;
    SECTION("a box that is pushed: the face that is fastest")
    {
        add_motion(box, "translate").velocity = Vec3(3.0, -4.0, 0);
        add_wall(scene, "plane").point.z() = -1e-6; // one that stands: the other's velocity is not the frame's
        expected = 4.0;
    }
    SECTION("one that turns about an edge")
    {
        auto& motion = add_motion(box, "turn");
        motion.axis = Vec3::UnitZ();
        motion.rate = 30.0;
        expected = 30.0 * 0.05;
    }
    SECTION("one that is shaken")
    {
        auto& motion = add_motion(box, "shake");
        motion.amplitude = Vec3(0, 0.01, 0);
        motion.frequency = 37.0;
        expected = 0.01 * 2.0 * std::numbers::pi * 37.0;
    }
    SECTION("one that is knocked for a ten-thousandth of the run")
    {
        add_motion(box, "table").table = {{0.50005, Vec3::Zero()}, {0.50015, Vec3(0.0004, 0, 0)}};
        expected = 4.0;
    }
    SECTION("one that is pushed first and turned later: never both")
    {
        auto& push = add_motion(box, "translate");
        push.velocity = Vec3(0, 0, 2.0);
        push.to = 0.1;
        auto& later = add_motion(box, "turn");
        later.axis = Vec3::UnitZ();
        later.rate = 0.001;
        later.from = 0.2;
        expected = 2.0;
    }
    SECTION("a plane that turns: where spheres are, not at its end")
    {
        auto& flap = add_wall(scene, "plane");
        flap.point.z() = -1e-6;
        flap.normal = Vec3(0, 0, 1);
        auto& turn = add_motion(flap, "turn");
        turn.axis = Vec3::UnitY();
        turn.rate = 30.0;
        Box spheres;
        for (const Vec3& x : build_scene(scene).simulation.state.position) spheres.extend(x);
        expected = 30.0 * spheres.max.x();
    }
    SECTION("a tube that turns across its axis")
    {
        auto& tube = add_wall(scene, "cylinder");
        tube.base = Vec3(0.025, 0.025, 0.1);
        tube.axis = Vec3::UnitZ();
        tube.radius = 0.004;
        tube.height = 0.05;
        auto& turn = add_motion(tube, "turn");
        turn.point = tube.base;
        turn.axis = Vec3::UnitX();
        turn.rate = 30.0;
        expected = 30.0 * 0.05;
    }
    SECTION("a disk that tilts")
    {
        auto& disk = add_wall(scene, "disk");
        disk.center = Vec3(0.025, 0.025, 0.1);
        disk.radius = 0.02;
        auto& turn = add_motion(disk, "turn");
        turn.point = disk.center;
        turn.axis = Vec3::UnitX();
        turn.rate = 30.0;
        expected = 30.0 * 0.02;
    }
    CHECK(closing_speed(scene) - still == Approx(expected).margin(1e-4));
}

TEST_CASE("a moving wall's speed, and so the step, does not depend on when the run ends", "[step_choice]")
{
    auto scene = small_scene();
    scene.time.duration = 0.0123;
    scene::WallTable& box = scene.wall[0];
    SECTION("shaken")
    {
        auto& motion = add_motion(box, "shake");
        motion.amplitude = Vec3(0, 0, 0.03);
        motion.frequency = 37.0;
    }
    SECTION("turned")
    {
        auto& motion = add_motion(box, "turn");
        motion.axis = Vec3(1, 2, 3).normalized();
        motion.rate = 77.0;
    }
    SECTION("sunk")
    {
        add_motion(box, "translate").velocity = Vec3(0, 0, -4.0);
    }
    SECTION("knocked after the end of the shorter run")
    {
        add_motion(box, "table").table = {{0.5, Vec3::Zero()}, {0.5001, Vec3(0.0004, 0, 0)}};
    }
    add_wall(scene, "plane").point.z() = -1.0;
    const StepChoice early = choice_of(scene);
    scene.time.duration = 10.0;
    const StepChoice late = choice_of(scene);
    CHECK(late.step == early.step);
    CHECK(early.closing_speed > 1.0);
}

TEST_CASE("a step of more than ten times the automatic one is warned of, one longer than the run is refused",
    "[step_choice][errors]")
{
    auto scene = small_scene();
    const double automatic = choice_of(scene).automatic();
    scene.time.step = {9.9 * automatic, ""};
    CHECK(build_scene(scene).report.warnings.empty());
    scene.time.step = {10.1 * automatic, ""};
    const auto warnings = build_scene(scene).report.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("10.1 times the automatic one"));
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
