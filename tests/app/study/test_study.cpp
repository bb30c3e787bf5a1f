// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command_line.hpp"
#include "app/loop/open_scene.hpp"
#include "app/study/findings.hpp"
#include "app/study/saved_state.hpp"
#include "tests/app/program.hpp"
#include "tests/support/study_csv.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace talus;
using Catch::Matchers::Contains;

namespace
{

/// Beads in a closed box, shaken down already when the study begins.
std::string small_bed()
{
    return R"(title = "A small bed"
[time]
duration = 0.35
[materials.glass]
[[contact]]
between = ["glass", "glass"]
[[fill]]
material = "glass"
count = 150
diameter = { distribution = "uniform", min = 0.009, max = 0.011 }
region = { shape = "box", min = [0, 0, 0], max = [0.05, 0.05, 0.25] }
[[wall]]
name = "box"
shape = "box"
max = [0.05, 0.05, 0.3]
open = ["z+"]
material = "glass"
[[sensor]]
name = "floor"
kind = "wall_force"
wall = "box"
from = 0.25
)";
}

} // namespace

TEST_CASE("a study of a small bed: more sweeps, less error; the reference is the dearest", "[app][study]")
{
    const Workplace place;
    place.write("bed.toml", small_bed());
    // No step stops for its residual: the least number of sweeps is what it makes.
    place.write("study.toml", R"(start = 0.2
settle = 0.05
set = ["solver.tolerance=1.0", "solver.pressure_scaling=false"]
[[vary]]
key = "solver.stabilisation"
values = ["projected"]
[[vary]]
key = "solver.min_sweeps"
values = ["1", "6", "40"]
[[vary]]
key = "wall.box.material"
values = ["cheese"]
)");
    const Outcome outcome = place.talus("study bed.toml --settings study.toml -o study --threads 2");
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("For no more overlap_95 than the default's"));
    auto rows = test::read_study_csv(place.read("study/study.csv"));
    const auto number = [&](const std::string& setting, const std::string& column) {
        INFO(setting << " " << column);
        REQUIRE(rows.contains(setting));
        REQUIRE(rows[setting].contains(column));
        return std::stod(rows[setting][column]);
    };
    CHECK(rows.size() == 7);
    const std::vector<std::string> sweeps = {
        "projected, min_sweeps=1", "projected, min_sweeps=6", "projected, min_sweeps=40"};
    for (const char* error : {"velocity_error", "residual"}) {
        CHECK(number(sweeps[1], error) < number(sweeps[0], error));
        CHECK(number(sweeps[2], error) < number(sweeps[1], error));
    }
    for (std::size_t k = 1; k < 3; ++k)
        CHECK(number(sweeps[k], "contact_updates_per_s") > number(sweeps[k - 1], "contact_updates_per_s"));
    for (const auto& [setting, columns] : rows)
        if (setting != "reference" && columns.at("status") == "done")
            CHECK(number(setting, "contact_updates_per_s") < number("reference", "contact_updates_per_s"));
    CHECK(number("default", "momentum_error") < 1e-9);
    CHECK(number("default", "floor_force_z") < 0.01);
    CHECK_THAT(rows["projected, material=cheese"]["status"], Contains("cheese"));
    CHECK_THAT(place.read("study/study.html"), Contains("<svg") && Contains("A small bed"));
}

TEST_CASE("the velocity error of a step is measured without a trace", "[app][study]")
{
    const Workplace place;
    place.write("bed.toml", small_bed());
    CommandLine line;
    line.scene = place.path("bed.toml").string();
    Simulation measured = open_scene(line).simulation, left_alone = open_scene(line).simulation;
    const auto both_make_steps = [&](int count) {
        for (int k = 0; k < count; ++k) {
            advance(measured);
            advance(left_alone);
        }
    };
    both_make_steps(400);
    const double error = velocity_error_of_next_step(measured);
    CHECK(error > 1e-12);
    CHECK(error < 0.1);
    both_make_steps(50);
    CHECK(state_of(measured) == state_of(left_alone));

    measured.model.solver.tolerance = 1e-10;
    measured.model.solver.max_sweeps = 5000;
    CHECK(velocity_error_of_next_step(measured) < 1e-3 * error);
}

TEST_CASE("a study that was stopped goes on where it was", "[app][study]")
{
    const Workplace place;
    place.write("bed.toml", small_bed());
    place.write("study.toml", R"(start = 0.25
settle = 0
reference = ["solver.min_sweeps=10"]
cross = []
[[vary]]
key = "solver.min_sweeps"
values = ["3", "4", "5", "6", "7", "8"]
)");
    const std::string command = "study bed.toml --settings study.toml -o study --threads 1";
    const Outcome stopped = place.shell("$TALUS " + command +
                                        " & pid=$!; until grep -q min_sweeps=3 study/rows.jsonl; do sleep "
                                        "0.01; done 2> /dev/null; kill -INT $pid; wait $pid");
    CHECK(stopped.exit_code == 130);
    CHECK_THAT(stopped.err, Contains("to go on: the same command again"));
    const std::string before = place.read("study/rows.jsonl");
    REQUIRE(place.shell("printf '{\"setting\": \"half' >> study/rows.jsonl").exit_code == 0); // a power cut
    CHECK(place.talus(command).exit_code == 0);
    const std::string after = place.read("study/rows.jsonl");
    CHECK(after.starts_with(before));
    CHECK(std::ranges::count(after, '\n') == 8);
    CHECK(std::ranges::count(before, '\n') < 8);
}

TEST_CASE("what a study cannot be is refused in one sentence", "[app][study]")
{
    const Workplace place;
    place.write("bed.toml", small_bed());
    place.write("late.toml", "start = 5.0\n");
    place.write("good.toml", "settle = 0.05\n");
    place.write("odd.toml", "[[vary]]\nkey = \"a\"\nvalue = 3\n");
    const auto refusal = [&](const std::string& arguments) {
        const Outcome outcome = place.talus("study bed.toml " + arguments);
        CHECK(outcome.exit_code == 2);
        return outcome.err;
    };
    CHECK(refusal("--settings late.toml") ==
          "talus: the study must end after 5.2 s, when its settings have settled, not at 0.35 s\n");
    CHECK(refusal("--settings odd.toml") == "odd.toml:3:1: unknown key 'value' in [[vary]]; did you mean 'values'?\n");
    CHECK(refusal("--settings none.toml") == "none.toml: no such file\n");
    REQUIRE(place.shell("mkdir full; touch full/thesis.tex").exit_code == 0);
    CHECK(refusal("--settings good.toml -o full") == "full: the folder is not empty and holds no study\n");
    CHECK(place.exists("full/thesis.tex"));
}

TEST_CASE("a study of a scene that was edited is another one; --force replaces it and nothing else", "[app][study]")
{
    const Workplace place;
    place.write("bed.toml", small_bed());
    place.write("study.toml", "settle = 0.05\nreference = [\"solver.min_sweeps=10\"]\nvary = []\n");
    const std::string command = "study bed.toml --settings study.toml -o study --quiet";
    REQUIRE(place.talus(command).exit_code == 0);
    place.write("study/thesis.tex", "years");
    CHECK(place.talus(command).exit_code == 0); // nothing to do
    place.write("bed.toml", replaced(small_bed(), "[materials.glass]", "[materials.glass]\ndensity = 2600.0"));
    const Outcome refused = place.talus(command);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err == "study: the folder holds another study, or one of the scene as it was; --force replaces it\n");
    CHECK(place.talus(command + " --force").exit_code == 0);
    CHECK(place.read("study/thesis.tex") == "years");
    CHECK(std::ranges::count(place.read("study/rows.jsonl"), '\n') == 2);
}
