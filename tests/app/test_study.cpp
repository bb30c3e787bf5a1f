// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command_line.hpp"
#include "app/open_scene.hpp"
#include "app/study/findings.hpp"
#include "app/study/saved_state.hpp"
#include "app/study/settings.hpp"
#include "app/study/study_page.hpp"
#include "app/study/study_result.hpp"
#include "app/study/workers.hpp"
#include "io/input_error.hpp"
#include "tests/app/program.hpp"
#include "tests/support/study_csv.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <unistd.h>

using namespace talus;
using Catch::Matchers::Contains;

namespace
{

scene::Study two_factors()
{
    scene::Study study;
    study.vary = {{"solver.stabilisation", {"matched", "projected"}}, {"solver.tolerance", {"draft", "fine"}},
        {"time.step", {"x0.5"}}};
    return study;
}

std::vector<std::string> names_of(const std::vector<Setting>& settings)
{
    std::vector<std::string> names;
    for (const Setting& setting : settings) names.push_back(setting.name);
    return names;
}

StudyRow row(const std::string& setting, double cpu, double overlap, double height, double flow, double spread = 0.0)
{
    StudyRow made{.setting = setting, .seed = 1};
    made.cpu = cpu;
    made.findings = {
        {"overlap_95", overlap, 0.0, "d"}, {"height", height, 0.0, "d"}, {"outlet mass_flow", flow, spread, "kg/s"}};
    made.profile = {1.0, 0.5};
    return made;
}

const std::vector<Setting> four_settings = {{"reference", {}}, {"default", {}}, {"fast", {}}, {"slow", {}}};

std::size_t kind(const StudyResult& result, const std::string& name)
{
    const auto found = std::ranges::find(result.kinds, name, &ErrorKind::name);
    REQUIRE(found != result.kinds.end());
    return static_cast<std::size_t>(found - result.kinds.begin());
}

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

TEST_CASE("one key is varied at a time, with every value of the crossed ones", "[app][study]")
{
    const auto names = names_of(settings_of(two_factors(), 1e-3));
    CHECK(names == std::vector<std::string>{"reference", "default", "matched", "projected", "matched, tolerance=draft",
                       "matched, tolerance=fine", "projected, tolerance=draft", "projected, tolerance=fine",
                       "matched, step=x0.5", "projected, step=x0.5"});
}

TEST_CASE("a grid has every combination, and no cross only single changes", "[app][study]")
{
    auto study = two_factors();
    study.cross = {"all"};
    CHECK(names_of(settings_of(study, 1e-3)) ==
          std::vector<std::string>{"reference", "default", "matched, tolerance=draft, step=x0.5",
              "matched, tolerance=fine, step=x0.5", "projected, tolerance=draft, step=x0.5",
              "projected, tolerance=fine, step=x0.5"});
    study.cross = {};
    CHECK(names_of(settings_of(study, 1e-3)) == std::vector<std::string>{"reference", "default", "matched", "projected",
                                                    "tolerance=draft", "tolerance=fine", "step=x0.5"});
}

TEST_CASE("a step may be given as a multiple of the scene's", "[app][study]")
{
    auto study = two_factors();
    const auto settings = settings_of(study, 2e-3);
    CHECK(settings.back().overrides == std::vector<std::string>{"solver.stabilisation=projected", "time.step=0.001"});
    study.vary.back().values = {"xy"};
    CHECK_THROWS_AS(settings_of(study, 2e-3), UsageError);
    study.vary.back().values = {"x-1"};
    CHECK_THROWS_AS(settings_of(study, 2e-3), UsageError);
}

TEST_CASE("a row of a study reads back, with what is not a number in it", "[app][study]")
{
    StudyRow made = row("projected, tolerance=fine", 2.5, 1e-4, 8.0, 1.25, std::nan(""));
    made.seed = 7;
    made.status = "t = 1 s: a \"sentence\"\nwith a line break";
    const std::string text = row_text(made);
    CHECK(text.find('\n') == std::string::npos);
    const StudyRow read = read_row(text);
    CHECK(read.setting == made.setting);
    CHECK(read.seed == 7);
    CHECK(read.status == made.status);
    CHECK(read.cpu == 2.5);
    REQUIRE(read.findings.size() == 3);
    CHECK(read.findings[0].value == 1e-4);
    CHECK(std::isnan(read.findings[2].spread));
    CHECK(read.profile == made.profile);
    CHECK_THROWS_AS(read_row("{}"), InputError);
    CHECK_THROWS_AS(read_row("half a li"), InputError);
}

TEST_CASE("what a run tells of itself is its error, the rest is compared with the reference", "[app][study]")
{
    StudyRow other = row("fast", 1.0, 3e-4, 7.5, 1.9, 0.03);
    other.profile = {0.9, 0.7};
    const auto result = compare(
        four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0, 0.04), row("default", 2.0, 1e-4, 8.0, 2.0), other});
    const StudyPoint& fast = result.points[2];
    CHECK(fast.errors[kind(result, "overlap_95")].value == 3e-4);
    CHECK(fast.errors[kind(result, "height")].value == Approx(0.5));
    CHECK(fast.errors[kind(result, "force_profile")].value == Approx(0.2));
    const auto flow = kind(result, "outlet mass_flow");
    CHECK(result.kinds[flow].of_sensor);
    CHECK(fast.errors[flow].value == Approx(0.05));
    CHECK(fast.errors[flow].spread == Approx(0.025));
    CHECK(std::isnan(fast.errors[kind(result, "creep")].value));
    CHECK_FALSE(result.points[3].is_done()); // it was not run
}

TEST_CASE("differences are averaged over seeds before their sign is dropped, and their scatter is told", "[app][study]")
{
    std::vector<StudyRow> rows;
    for (std::int64_t seed = 1; seed <= 4; ++seed)
        for (const char* name : {"reference", "default"}) {
            const bool is_reference = std::string(name) == "reference";
            rows.push_back(row(name, 1.0, 1e-4, is_reference ? 8.0 : seed % 2 ? 8.1 : 7.9, 1.0));
            rows.back().seed = seed;
        }
    const auto result = compare({{"reference", {}}, {"default", {}}}, rows);
    const ErrorValue height = result.standard().errors[kind(result, "height")];
    CHECK(height.value == Approx(0.0).margin(1e-12));
    CHECK(height.spread == Approx(0.1 * 2.0 / std::sqrt(3.0) / 2.0)); // s/√4 of ±0.1
}

TEST_CASE("one seed that fails makes the setting fail, with its sentence", "[app][study]")
{
    std::vector<StudyRow> rows = {row("reference", 9.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.0)};
    rows.push_back(row("fast", 1.0, 1e-3, 8.0, 2.0));
    rows.push_back(rows.back());
    rows.back().seed = 2;
    rows.back().status = "sphere 3 left the world";
    const auto result = compare(four_settings, rows);
    CHECK(result.points[2].status == "sphere 3 left the world");
    CHECK_THAT(study_csv(result), Contains("\"fast\",\"sphere 3 left the world\""));
    CHECK_THAT(study_page(result, {"A title", ""}), Contains("sphere 3 left the world"));
}

TEST_CASE("the front has no setting that a cheaper one beats, and advice names the cheapest", "[app][study]")
{
    const std::vector<Setting> settings = {
        {"reference", {}}, {"default", {}}, {"fast", {}}, {"slow", {}}, {"worse", {}}, {"good", {}}};
    const auto result =
        compare(settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 1.99, 0.001),
                              row("fast", 1.0, 3e-3, 8.0, 1.5), row("slow", 8.0, 1e-5, 8.0, 2.0),
                              row("worse", 4.0, 2e-4, 8.0, 2.0), row("good", 1.5, 1e-4, 8.0, 1.995, 0.001)});
    CHECK(front(result, kind(result, "overlap_95")) == std::vector<std::size_t>{2, 5, 3});
    const auto sentences = advice(result);
    CHECK(std::ranges::count(sentences,
              "For no more overlap_95 than the default's 0.0001 d: use good: 1.3 × faster than the default.") == 1);
    CHECK(std::ranges::count(sentences, "For 1 % in outlet mass_flow: use good: 1.3 × faster than the default.") == 1);
}

TEST_CASE("where the measure's own spread is too large, no setting is recommended", "[app][study]")
{
    const auto result =
        compare(four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.01, 0.1)});
    const auto sentences = advice(result);
    CHECK(std::ranges::any_of(sentences, [](const std::string& sentence) {
        return sentence.starts_with("No setting is sure to be within 1 % in outlet mass_flow (the default differs by "
                                    "0.5 ± 9.8 %);");
    }));
}

TEST_CASE("a setting that costs as much as a default that is not good enough is named", "[app][study]")
{
    const auto result =
        compare(four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.1),
                                   row("fast", 1.97, 1e-4, 8.0, 2.001, 1e-4)});
    CHECK(std::ranges::count(
              advice(result), "For 1 % in outlet mass_flow: use fast: it takes as long as the default.") == 1);
}

TEST_CASE("measures that one setting is right for stand in one sentence, and of many the first", "[app][study]")
{
    const auto with_many = [](StudyRow made, double value, double spread) {
        for (int k = 0; k < 9; ++k) made.findings.push_back({"floor force_" + std::to_string(k), value, spread, "N"});
        return made;
    };
    const auto sentences_with = [&](double spread) {
        return advice(compare(four_settings, {with_many(row("reference", 100.0, 1e-6, 8.0, 2.0), 5.0, 0.0),
                                                 with_many(row("default", 2.0, 1e-4, 8.0, 2.0), 5.0, spread),
                                                 with_many(row("fast", 1.0, 1e-3, 8.0, 2.0), 5.0, spread)}));
    };
    CHECK(std::ranges::count(sentences_with(0.0), "For 1 % in outlet mass_flow, floor force_0, floor force_1, floor "
                                                  "force_2, floor force_3, floor force_4 and 4 "
                                                  "more: use fast: 2 × faster than the default.") == 1);
    const auto unsure = sentences_with(0.5);
    CHECK(std::ranges::count_if(unsure, [](const std::string& s) { return s.starts_with("No setting is sure"); }) == 1);
    CHECK_THAT(unsure.back(), Contains("floor force_0 (the default differs by 0 ± 20 %)") && Contains("and 3 more;"));
}

TEST_CASE("settings that came to the same run are one, with the mean of their CPU times", "[app][study]")
{
    const auto result =
        compare(four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.0),
                                   row("fast", 3.5, 1e-4, 8.0, 2.0), row("slow", 2.0, 1e-4, 8.0, 2.0)});
    CHECK(result.standard().cpu == Approx(2.5));
    CHECK(result.points[2].status == "the same run as default");
    CHECK(result.points[3].status == "the same run as default");
}

TEST_CASE("a task that crashes takes nothing with it", "[app][study]")
{
    std::map<std::size_t, std::string> heard, endings;
    const std::string long_words(1000000, 'x');
    run_in_copies(
        4, 2,
        [&](std::size_t task) -> std::string {
            if (task == 1) ::kill(::getpid(), SIGKILL);
            if (task == 2) throw std::bad_alloc();
            return task == 3 ? long_words : "words";
        },
        [&](std::size_t task, const std::string& words, const std::string& ending) {
            heard[task] = words;
            endings[task] = ending;
        },
        [] { return true; });
    CHECK(heard[0] == "words");
    CHECK(endings[0] == "");
    CHECK(endings[1] == "crashed: Killed");
    CHECK_THAT(endings[2], Contains("without a result"));
    CHECK(heard[3] == long_words);
}

TEST_CASE("tasks are ended where the study is not to go on", "[app][study]")
{
    int done = 0, asked = 0;
    run_in_copies(
        100, 2,
        [](std::size_t) -> std::string {
            ::sleep(100);
            return "";
        },
        [&](std::size_t, const std::string&, const std::string&) { ++done; }, [&] { return ++asked < 3; });
    CHECK(done == 0);
}

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
            step(measured);
            step(left_alone);
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
