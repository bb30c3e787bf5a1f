// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a run with --report ends with a page, and names it", "[app][page]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box, "--report");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out, Contains("page: out/report.html"));
    CHECK_THAT(place.read("out/report.html"), StartsWith("<!doctype html>"));
}

TEST_CASE("a run that a signal stops has its page too, and keeps its exit code", "[app][page]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    const Outcome outcome = place.talus_until(
        "out/frames/particles_000005.vtp", "INT", "run scene.toml -o out --until 1000 --threads 1 --report");
    CHECK(outcome.exit_code == 130);
    CHECK_THAT(outcome.err, StartsWith("stopped by SIGINT") && Contains("talus resume out"));
    CHECK_THAT(outcome.out, Contains("page: out/report.html"));
    CHECK_THAT(place.read("out/report.html"), Contains("\"status\": \"interrupted\""));
}

TEST_CASE("where no page can be made the run keeps its exit code, and one sentence tells it", "[app][page]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    place.write("out/report.html", "notes of my own");
    const Outcome outcome = place.talus("resume out --until 0.06 --threads 1 --quiet --report");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, StartsWith("the run has no page: ") && Contains("is no page of Talus"));
    CHECK(line_of(outcome.err + "|", "|") == 2);
    CHECK(place.read("out/report.html") == "notes of my own");
}

TEST_CASE("report and watch pass on what the scripts say and how they end", "[app][page]")
{
    const Workplace place;
    for (const char* verb : {"report", "watch"}) {
        const Outcome nowhere = place.talus(std::string(verb) + " nowhere");
        CHECK(nowhere.exit_code == 2);
        CHECK_THAT(nowhere.err, Contains("nowhere holds no run of Talus"));
    }
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    CHECK(place.talus("report out -o nowhere/page.html").exit_code == 4);
    CHECK(place.talus("report out -o page.html --frames 3").exit_code == 0);
    CHECK_THAT(place.read("page.html"), Contains("\"numbers\": [0, 2, 4, 5]"));
}
