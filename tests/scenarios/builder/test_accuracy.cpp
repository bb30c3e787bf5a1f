// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/step_choice.hpp"
#include "tests/scenarios/measured_settings.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;
using scene::MeasuredSetting;

namespace
{

/// A scene that has them to choose from.
scene::Scene scene_to_choose_for()
{
    auto scene = small_scene();
    scene.measured = measured_settings();
    return scene;
}

} // namespace

TEST_CASE("finer settings of the table keep to finer targets", "[accuracy]")
{
    const auto& settings = measured_settings();
    REQUIRE(settings.size() >= 3);
    for (std::size_t k = 1; k < settings.size(); ++k) {
        CHECK(settings[k].bound < settings[k - 1].bound);
        CHECK(settings[k].overlap < settings[k - 1].overlap);
        CHECK(settings[k].creep < settings[k - 1].creep);
        CHECK(settings[k].approach < settings[k - 1].approach);
        CHECK(settings[k].tolerance < settings[k - 1].tolerance);
    }
}

TEST_CASE("the coarsest setting that is accurate enough is taken", "[accuracy]")
{
    for (const char* law : {"matched", "projected"})
        for (const MeasuredSetting& measured : measured_settings()) {
            auto scene = scene_to_choose_for();
            scene.solver.stabilisation = law;
            scene.accuracy = std::to_string(100.0 * measured.bound + 1e-5) + " %";
            const auto [chosen, report, output] = build_scene(scene);
            INFO(law << ", " << scene.accuracy << ": " << report.accuracy);
            const StepChoice expected =
                choose_step(scene, chosen, measure_bed(chosen), {measured.overlap, measured.creep, measured.approach});
            CHECK(chosen.model.time_step == expected.step);
            CHECK(chosen.model.solver.tolerance == measured.tolerance);
            CHECK_THAT(report.accuracy, Contains("approach"));
        }
}

TEST_CASE("an accuracy of 3 % is what a scene gets that asks for none", "[accuracy]")
{
    auto scene = scene_to_choose_for();
    const Model usual = build_scene(scene).simulation.model;
    scene.accuracy = "3%";
    const Model asked = build_scene(scene).simulation.model;
    CHECK(asked.time_step == usual.time_step);
    CHECK(asked.solver.min_sweeps == usual.solver.min_sweeps);
    CHECK(asked.solver.tolerance == usual.solver.tolerance);
}

TEST_CASE("a target that the scene gives stands, whatever its accuracy", "[accuracy]")
{
    auto scene = scene_to_choose_for();
    scene.targets.approach = {0.01, ""};
    const double usual = build_scene(scene).simulation.model.time_step;
    scene.accuracy = "100%";
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.time_step == usual);
    CHECK_THAT(report.accuracy, Contains("stands: targets.approach"));
}

TEST_CASE("what a scene sets itself stands, whatever its accuracy", "[accuracy]")
{
    auto scene = scene_to_choose_for();
    scene.accuracy = "100%";
    scene.time.step = {1e-4, ""};
    scene.solver.min_sweeps = 7;
    scene.solver.tolerance = {1e-5, ""};
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(simulation.model.time_step == 1e-4);
    CHECK(simulation.model.solver.min_sweeps == 7);
    CHECK(simulation.model.solver.tolerance == 1e-5);
    CHECK_THAT(report.accuracy, Contains("stands: time.step, solver.min_sweeps, solver.tolerance"));
}

TEST_CASE("without a wish for accuracy a scene runs as usual", "[accuracy]")
{
    const auto [simulation, report, output] = build_scene(scene_to_choose_for());
    CHECK(report.accuracy.empty());
    CHECK(simulation.model.solver.tolerance == 1e-2);
}

TEST_CASE("an accuracy that is none is refused", "[accuracy]")
{
    auto scene = scene_to_choose_for();
    for (const char* text : {"1", "0%", "-1%", "101%", "1%%", "%", "one%", "nan%", "1% "}) {
        scene.accuracy = text;
        INFO(text);
        CHECK_THROWS_WITH(build_scene(scene), Contains("percentage"));
    }
    scene.accuracy = "1e-9%";
    CHECK_THROWS_WITH(build_scene(scene), Contains("finer than what was measured"));
}
