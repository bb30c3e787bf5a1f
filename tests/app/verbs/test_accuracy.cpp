// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;

namespace
{

/// Beads of two sizes in a square shaft.
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

TEST_CASE("a run tells what an accuracy picked", "[app][accuracy]")
{
    const Workplace place;
    place.write("shaft.toml", shaft);
    const Outcome run = place.talus("run shaft.toml --accuracy 1% --until 0.002 -o out");
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("accuracy 1 %: overlap 0.0005 d"));
    CHECK_THAT(place.read("out/scene.resolved.toml"), Contains("accuracy = \"1%\""));

    const Outcome none = place.talus("run shaft.toml --accuracy none -o out2");
    CHECK(none.exit_code == 2);
    CHECK_THAT(none.err, Contains("--set accuracy='none': 'none' must be a percentage above 0 and up to 100"));

    place.write("wrong.toml", "accuracy = \"0%\"\n" + shaft);
    const Outcome wrong = place.talus("check wrong.toml");
    CHECK(wrong.exit_code == 2);
    CHECK_THAT(wrong.err, Contains("wrong.toml:1:") && Contains("'0%' must be a percentage"));
}
