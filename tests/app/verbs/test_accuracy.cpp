// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"
#include "tests/support/study_csv.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;

namespace
{

/// Beads of two sizes in a square shaft, eight diameters wide: no scene that a study shipped with Talus has.
const std::string shaft = R"(title = "Two sizes in a shaft"
[time]
duration = 0.9
[materials.glass]
[materials.steel]
[[contact]]
between = ["glass", "glass"]
friction = 0.6
restitution = 0.3
[[contact]]
between = ["glass", "steel"]
friction = 0.4
[[fill]]
material = "glass"
count = 450
diameter = { distribution = "uniform", min = 0.007, max = 0.013 }
region = { shape = "box", min = [0, 0, 0], max = [0.08, 0.08, 0.4] }
[[wall]]
name = "shaft"
shape = "box"
max = [0.08, 0.08, 0.4]
open = ["z+"]
material = "steel"
[[sensor]]
name = "floor"
kind = "wall_force"
wall = "shaft"
from = 0.5
)";

} // namespace

TEST_CASE("an accuracy that was asked for holds in a scene that no study has seen", "[app][accuracy][study]")
{
    const Workplace place;
    place.write("shaft.toml", shaft);
    place.write("study.toml", R"(start = 0.4
settle = 0.2
end = 0.8
cross = []
[[vary]]
key = "accuracy"
values = ["15%", "1%", "0.6%"]
)");
    const Outcome outcome = place.talus("study shaft.toml --settings study.toml -o study --threads 2");
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    auto rows = talus::test::read_study_csv(place.read("study/study.csv"));
    const auto number = [&](const std::string& setting, const std::string& column) {
        return std::stod(rows.at(setting).at(column));
    };
    CHECK(number("accuracy=15%", "contact_updates_per_s") < 0.9 * number("default", "contact_updates_per_s"));
    CHECK(number("accuracy=1%", "overlap_95") < 0.8 * number("default", "overlap_95"));
    CHECK(number("accuracy=0.6%", "overlap_95") < 0.5 * number("default", "overlap_95"));
    for (const auto& [setting, promised] :
        {std::pair("accuracy=15%", 0.15), std::pair("accuracy=1%", 0.01), std::pair("accuracy=0.6%", 0.006)}) {
        INFO(setting);
        REQUIRE(rows[setting]["status"] == "done");
        for (const char* error : {"velocity_error", "overlap_95", "creep", "floor_force_z"}) {
            INFO(error);
            CHECK(number(setting, error) <= promised);
        }
    }
}

TEST_CASE("the reference of a study is as fine whatever the accuracy of its scene", "[app][accuracy][study]")
{
    const Workplace place;
    place.write("shaft.toml", shaft);
    place.write("study.toml", "start = 0\nsettle = 0\nend = 0.02\ncross = []\nvary = []\n");
    const auto findings_of = [&](const std::string& setting, const std::string& changes) {
        const Outcome outcome = place.talus("study shaft.toml --force --settings study.toml -o study " + changes);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const std::string rows = place.read("study/rows.jsonl");
        const std::size_t row = rows.find("\"setting\":\"" + setting + "\"");
        const std::size_t begin = rows.find("\"findings\"", row);
        REQUIRE(begin != std::string::npos);
        return rows.substr(begin, rows.find('\n', begin) - begin);
    };
    CHECK(findings_of("reference", "") == findings_of("reference", "--set accuracy=100%"));
    CHECK(findings_of("default", "") != findings_of("default", "--set accuracy=100%"));
}

TEST_CASE("a run tells what an accuracy picked", "[app][accuracy]")
{
    const Workplace place;
    place.write("shaft.toml", shaft);
    const Outcome run = place.talus("run shaft.toml --accuracy 1% --until 0.002 -o out");
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("accuracy 1 %: time step x"));
    CHECK_THAT(place.read("out/scene.resolved.toml"), Contains("accuracy = \"1%\""));

    const Outcome none = place.talus("run shaft.toml --accuracy none -o out2");
    CHECK(none.exit_code == 2);
    CHECK_THAT(none.err, Contains("--set accuracy='none': 'none' must be a percentage above 0 and up to 100"));

    place.write("wrong.toml", "accuracy = \"0%\"\n" + shaft);
    const Outcome wrong = place.talus("check wrong.toml");
    CHECK(wrong.exit_code == 2);
    CHECK_THAT(wrong.err, Contains("wrong.toml:1:") && Contains("'0%' must be a percentage"));
}
