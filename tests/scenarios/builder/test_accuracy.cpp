// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/step_choice.hpp"
#include "scenarios/scene_error.hpp"
#include "tests/scenarios/measured_settings.hpp"
#include "tests/scenarios/small_scene.hpp"
#include "tests/support/study_csv.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

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

/// What a study found of one setting.
struct Found {
    double error = 0.0;
    double cost = 0.0; ///< by that of the usual setting with `matched`
    std::string worst;
};

double number(const std::map<std::string, std::string>& row, const std::string& column)
{
    const auto found = row.find(column);
    return found == row.end() || found->second.empty() ? std::nan("") : std::stod(found->second);
}

/// Where a setting came to the same run as another, that other's row.
const std::map<std::string, std::string>& row_of(const StudyTable& table, const std::string& setting)
{
    const std::string same = "the same run as ";
    const auto& row = table.at(setting);
    const std::string& status = row.at("status");
    return status.starts_with(same) ? row_of(table, status.substr(same.size())) : row;
}

/// As the studies call it.
std::string name_of(const MeasuredSetting& measured)
{
    std::string name = measured.stabilisation;
    const MeasuredSetting& s = measured;
    char step[40] = "";
    if (s.step_factor != 1.0) std::snprintf(step, sizeof step, ", step=x%g", s.step_factor);
    name += step;
    if (s.min_sweeps > 0) name += ", min_sweeps=" + std::to_string(s.min_sweeps);
    if (s.tolerance == 5e-2) name += ", tolerance=draft";
    if (s.tolerance == 1e-3) name += ", tolerance=fine";
    return name;
}

/// Errors that accuracy is about: of the velocities [√(g d)], overlap of all but 5 % of the contacts [d], in beds at
/// rest their creep [d/s], and of a flow or a heap's slope by its value, as far as it stands out from chance (95 %):
/// that takes several seeds, which the drum's slope does not have.
std::vector<std::pair<std::string, double>> errors_in(
    const std::string& study, const std::map<std::string, std::string>& row)
{
    std::vector<std::pair<std::string, double>> errors;
    for (const char* name : {"velocity_error", "overlap_95"}) errors.emplace_back(name, number(row, name));
    if (study.starts_with("column") || study == "imported_pile") errors.emplace_back("creep", number(row, "creep"));
    for (const char* sensor : {"outlet_mass_flow", "heap_angle"}) {
        const double error = number(row, sensor), spread = number(row, std::string(sensor) + "_spread");
        if (std::isfinite(error) && std::isfinite(spread)) errors.emplace_back(sensor, error - 1.96 * spread);
    }
    return errors;
}

Found found_in(const std::filesystem::path& results, const MeasuredSetting& measured)
{
    Found found;
    double log_sum = 0.0, count = 0.0;
    for (const auto& entry : std::filesystem::directory_iterator(results)) {
        if (entry.path().extension() != ".csv") continue;
        std::ifstream file(entry.path());
        const StudyTable table = read_study_csv(std::string(std::istreambuf_iterator<char>(file), {}));
        const auto& row = row_of(table, name_of(measured));
        const std::string study = entry.path().stem();
        INFO(study << ", " << name_of(measured) << ": " << row.at("status"));
        REQUIRE(row.at("status") == "done");
        log_sum += std::log(number(row, "cpu_s_per_s") / number(row_of(table, "matched"), "cpu_s_per_s"));
        count += 1.0;
        for (const auto& [name, error] : errors_in(study, row))
            if (error > found.error) found = {error, 0.0, name + " of " + study};
    }
    found.cost = std::exp(log_sum / count);
    return found;
}

} // namespace

TEST_CASE("the settings behind accuracy are what the studies found", "[accuracy]")
{
    for (const MeasuredSetting& measured : measured_settings()) {
        const Found found = found_in(TALUS_SOURCE_DIR "/tests/studies/results", measured);
        INFO(name_of(measured) << ": error " << found.error << ", " << found.worst << ", cost " << found.cost);
        CHECK(measured.error == Approx(found.error).epsilon(0.05));
        CHECK(measured.error >= found.error);
        CHECK(measured.worst == found.worst);
        CHECK(measured.cost == Approx(found.cost).epsilon(0.05));
    }
}

TEST_CASE("dearer settings of the table are more accurate", "[accuracy]")
{
    for (const char* law : {"matched", "projected"}) {
        const MeasuredSetting* before = nullptr;
        for (const MeasuredSetting& measured : measured_settings()) {
            if (measured.stabilisation != law) continue;
            if (before) {
                CHECK(measured.error < before->error);
                CHECK(measured.cost > before->cost);
            }
            before = &measured;
        }
        CHECK(before);
    }
}

TEST_CASE("the cheapest setting that is accurate enough is taken", "[accuracy]")
{
    for (const MeasuredSetting& measured : measured_settings()) {
        auto scene = scene_to_choose_for();
        scene.solver.stabilisation = measured.stabilisation;
        scene.accuracy = std::to_string(100.0 * measured.error + 1e-5) + " %";
        auto asking_nothing = scene;
        asking_nothing.accuracy = "";
        const Simulation usual = build_scene(asking_nothing).simulation;
        const auto [chosen, report, output] = build_scene(scene);
        INFO(scene.accuracy << ": " << report.accuracy);
        const double by_speed = 0.1 * chosen.model.min_diameter / choose_step(scene, chosen).fastest_speed;
        CHECK(chosen.model.time_step == Approx(std::min(measured.step_factor * usual.model.time_step, by_speed)));
        CHECK(chosen.model.solver.min_sweeps ==
              (measured.min_sweeps > 0 ? measured.min_sweeps : usual.model.solver.min_sweeps));
        CHECK(chosen.model.solver.tolerance == measured.tolerance);
        CHECK_THAT(report.accuracy, Contains(measured.worst));
    }
}

TEST_CASE("a coarse accuracy leaves the fastest sphere its tenth of a diameter in a step", "[accuracy]")
{
    auto scene = scene_to_choose_for();
    scene.fill[0].velocity = Vec3(0, 0, -30.0);
    const Simulation usual = build_scene(scene).simulation;
    scene.accuracy = "100%";
    CHECK(build_scene(scene).simulation.model.time_step == usual.model.time_step);
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
    CHECK(simulation.model.solver.min_sweeps == 2);
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
