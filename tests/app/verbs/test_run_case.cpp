// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

// Sweeps as a whole, whatever is killed: tests/sweeps/check_sweep.py.

namespace
{

/// A sweep of beads in a box: with a friction that is good, one that is refused, and the last in a world that they
/// leave.
void make_sweep(const Workplace& place)
{
    place.write("beads.toml", beads_in_a_box);
    place.write("sweep.toml", R"(scene = "beads.toml"
reports = false
[set]
time.duration = 1.0
[design]
kind = "list"
[vary]
contact.glass-glass.friction = [0.3, -1, 0.3]
wall.tray.open = [["z+"], ["z+"], ["z-", "z+"]]
)");
    REQUIRE(place.talus("sweep sweep.toml -o sweep --quiet").exit_code == 0);
}

} // namespace

TEST_CASE("a case of a sweep is run once, and then left as it is", "[sweep]")
{
    const Workplace place;
    make_sweep(place);
    CHECK(place.talus("run sweep --case 1 --quiet").exit_code == 0);
    const std::string summary = place.read("sweep/cases/0001/summary.json");
    const Outcome again = place.talus("run sweep --case 1");
    CHECK(again.exit_code == 0);
    CHECK(again.out == "case 1 of sweep is settled: done\n");
    CHECK(place.read("sweep/cases/0001/summary.json") == summary);
}

TEST_CASE("a case that fails is a result, with its reason", "[sweep]")
{
    const Workplace place;
    make_sweep(place);
    const Outcome refused = place.talus("run sweep --case 2 --quiet");
    CHECK(refused.exit_code == 0);
    CHECK_THAT(refused.err, Catch::StartsWith("case 2 of sweep failed: --set contact.glass-glass.friction=-1: "));
    CHECK_THAT(
        place.read("sweep/cases/0002/refused.txt"), Catch::StartsWith("--set contact.glass-glass.friction=-1: "));
    const Outcome escaped = place.talus("run sweep --case 3 --quiet");
    CHECK(escaped.exit_code == 0);
    CHECK_THAT(escaped.err, Catch::EndsWith("case 3 of sweep failed, as its summary says\n"));
    CHECK(place.talus("run sweep --case 3").out == "case 3 of sweep is settled: failed\n");
}

TEST_CASE("a case that was stopped goes on from its checkpoint", "[sweep]")
{
    const Workplace place;
    make_sweep(place);
    const Outcome stopped = place.talus_until("sweep/cases/0001/metrics.csv", "TERM", "run sweep --case 1 --quiet");
    CHECK(stopped.exit_code == 128 + 15);
    const Outcome on = place.talus("run sweep --case 1");
    CHECK(on.exit_code == 0);
    CHECK_THAT(on.out, Catch::Contains("resumed from"));
    CHECK_THAT(place.read("sweep/cases/0001/summary.json"), Catch::Contains("\"status\": \"done\""));
}
