// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;

TEST_CASE("an earlier run is replaced with --force only", "[app][output]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    const std::string first = place.read("out/metrics.csv");

    const Outcome refused = place.run(beads_in_a_box, "--until 0.02");
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("out") && Contains("--force"));
    CHECK(place.read("out/metrics.csv") == first);

    CHECK(place.run(beads_in_a_box, "--until 0.02 --force").exit_code == 0);
    CHECK(place.read("out/metrics.csv").size() < first.size());
    CHECK_FALSE(place.exists("out/frames/particles_000005.vtp")); // of the longer, earlier run
}

TEST_CASE("a folder that Talus did not write is never replaced", "[app][output]")
{
    const Workplace place;
    std::filesystem::create_directory(place.path("out"));
    place.write("out/thesis.tex", "ten years of work");
    const std::string force = GENERATE(as<std::string>{}, "", "--force");
    const Outcome outcome = place.run(beads_in_a_box, force);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains("out"));
    CHECK(place.read("out/thesis.tex") == "ten years of work");
    CHECK_FALSE(place.exists("out/summary.json"));
}

TEST_CASE("an empty folder is as good as none", "[app][output]")
{
    const Workplace place;
    std::filesystem::create_directory(place.path("out"));
    CHECK(place.run(beads_in_a_box).exit_code == 0);
    CHECK(place.exists("out/summary.json"));
}

TEST_CASE("a folder that cannot be made ends with 4 and names it", "[app][output]")
{
    const Workplace place;
    place.write("file", "in the way");
    place.write("scene.toml", beads_in_a_box);
    const Outcome outcome = place.talus("run scene.toml -o file/out");
    CHECK(outcome.exit_code == 4);
    CHECK_THAT(outcome.err, Contains("file/out"));
    CHECK(line_of(outcome.err + "|", "|") == 2);
}

TEST_CASE(
    "a disk that fills up ends with 4, names the file, and keeps what was written", "[app][output][not under thread]")
{
    // a limit on the size of a file stands for the full disk: metrics.csv outgrows it
    const Workplace place;
    place.write("scene.toml", replaced(beads_in_a_box, "metrics_interval = 0.01", "metrics_interval = 1e-4"));
    const Outcome outcome = place.talus("run scene.toml -o out --threads 1", "trap \"\" XFSZ; ulimit -f 16;");
    CHECK(outcome.exit_code == 4);
    CHECK_THAT(outcome.err, Contains("metrics.csv"));
    CHECK(place.exists("out/frames/particles_000000.vtp"));
    CHECK_FALSE(place.exists("out/summary.json"));
}
