// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("wrong arguments end with 2 and one sentence", "[app][command line]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    const std::string arguments = GENERATE(as<std::string>{}, "", "fly", "run", "run scene.toml --fast",
        "run scene.toml --threads none", "run scene.toml --threads 0", "run scene.toml --until -1",
        "run scene.toml --quiet --verbose", "run nowhere.toml", "check nowhere");
    CAPTURE(arguments);
    const Outcome outcome = place.talus(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("talus: "));
    CHECK(line_of(outcome.err + "|", "|") == 2);
    CHECK_FALSE(place.exists("out"));
}

TEST_CASE("every verb has help with an example", "[app][command line]")
{
    const Workplace place;
    const std::string verb = GENERATE(as<std::string>{}, "new", "run", "resume", "report", "watch", "check", "keys",
        "list", "export", "dump", "solve", "study");
    const Outcome outcome = place.talus(verb + " --help");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("Example: talus " + verb));
}

TEST_CASE("the version names the libraries", "[app][command line]")
{
    const Workplace place;
    const Outcome outcome = place.talus("--version");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("talus 0."));
    CHECK_THAT(outcome.out, Contains("(GNU 1") || Contains("(Clang 1"));
    for (const char* library :
        {"OpenMP ", "Eigen 3.", "CGAL 5.", "VTK 9.", "toml++ 3.", "nlohmann-json 3.", "CLI11 2.", "fmt 9.", "zlib 1."})
        CHECK_THAT(outcome.out, Contains(library));
}

TEST_CASE("list names every supplied scene with its title", "[app][command line]")
{
    const Workplace place;
    const Outcome outcome = place.talus("list");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, !Contains("cannot be read"));
    for (const auto& entry : std::filesystem::directory_iterator(TALUS_SOURCE_DIR "/scenarios"))
        if (entry.path().extension() == ".toml") CHECK_THAT(outcome.out, Contains(entry.path().stem().string() + " "));
}

TEST_CASE("check counts what a pour lets in while the run lasts", "[app][command line]")
{
    const Workplace place;
    const std::string pour = "[[pour]]\nmaterial = \"glass\"\ndiameter = 0.01\nregion = { shape = \"box\", "
                             "min = [0, 0, 0.1], max = [0.05, 0.05, 0.2] }\ncount = 1000000\n";
    place.write("scene.toml", beads_in_a_box + pour + "rate = 150\n");
    const Outcome outcome = place.talus("check scene.toml --until 1");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(
        outcome.out, Contains("8 at the start, 150 poured in") && Contains(" s on one thread, or half or twice"));
    // At any rate no more than fall out of its region to make room for others.
    place.write("scene.toml", beads_in_a_box + pour + "rate = 1e9\n");
    const std::string out = place.talus("check scene.toml --until 1").out;
    const double count = std::stod(out.substr(out.find("at the start, ") + 14));
    CHECK(count > 300.0);
    CHECK(count < 3000.0);
}

TEST_CASE("check says what a scene holds and needs, and writes nothing", "[app][command line]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    const Outcome outcome = place.talus("check scene.toml --until 0.1");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out, Contains("8 at the start, 0 poured in, 0.01047 kg") &&
                                Contains("'tray'               0.05 x 0.05 x 0.05 m = 5 x 5 x 5 d; x 0 to 0.05") &&
                                Contains("world: x from -0.05 to 0.1, y from -0.05 to 0.1, z from -0.05 up, in m") &&
                                Contains("overlaps at the start: none"));
    CHECK_THAT(outcome.out, Contains("memory: about") && Contains("disk: up to") && Contains("time: 218 steps; "));
    CHECK_THAT(outcome.out, !Contains("duration = "));
    CHECK_FALSE(place.exists("out"));
    const Outcome resolved = place.talus("check scene.toml --until 0.1 --resolved");
    CHECK_THAT(
        resolved.out, StartsWith(outcome.out) && Contains("duration = 0.1 ") && Contains("on_escape = \"stop\""));
}

TEST_CASE("a sensor that has nothing to say says why", "[app][command line]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box + R"(
[[sensor]]
name = "late"
kind = "mass_flow"
from = 3.5
[[sensor]]
name = "heap"
kind = "repose"
)");
    CHECK_THAT(outcome.out, Contains("late mass_flow               it averages from 3.5 s on, and the run ended at") &&
                                Contains("heap angle                   no heap: ") && !Contains("nan"));
}

TEST_CASE("grains that roll away on a plane stay in the world", "[app][command line]")
{
    const Workplace place;
    const std::string plane = replaced(beads_in_a_box, "count = 8", "count = 8\nvelocity = [3, 0, 0]");
    const Outcome outcome = place.run(plane + R"(
[[wall]]
name = "floor"
shape = "plane"
material = "glass"
)",
        "--set wall.tray.remove_at=0 --until 0.2");
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
}

TEST_CASE("two fills in one place are refused, for they cannot both be there without overlap", "[app][command line]")
{
    // each region has room for one bead only
    const std::string one = R"(
[[fill]]
material = "glass"
count = 1
diameter = 0.01
region = { shape = "box", min = [0.02, 0.02, 0.02], max = [0.0305, 0.0305, 0.0305] }
spacing = 1.05
)";
    const Workplace place;
    place.write("scene.toml", replaced(beads_in_a_box, "count = 8", "count = 0") + one + one);
    const Outcome outcome = place.talus("check scene.toml");
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains("the region holds 0 spheres"));
}

TEST_CASE("keys lists every key with what is allowed, its default, unit and meaning", "[app][command line]")
{
    const Workplace place;
    const Outcome all = place.talus("keys");
    CHECK(all.exit_code == 0);
    CHECK_THAT(all.out, Contains("\ntime\n  step ") &&
                            Contains("duration               a number of at least 0 [s]; default 1.0\n") &&
                            Contains("simulated time\n") && Contains("\nfill.region\n") && Contains("\nmaterials\n"));
    const Outcome wall = place.talus("keys wall");
    CHECK_THAT(
        wall.out, Contains("hole_radius            a number of at least 0 [m]; default 0.0; with shape disk\n") &&
                      !Contains("duration"));
}

TEST_CASE("a log file has what was printed, each line with the time of day", "[app][command line]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box, "--verbose --log-file run.log");
    REQUIRE(outcome.exit_code == 0);
    const std::string log = place.read("run.log");
    CHECK(std::count(log.begin(), log.end(), '\n') == std::count(outcome.out.begin(), outcome.out.end(), '\n') +
                                                          std::count(outcome.err.begin(), outcome.err.end(), '\n'));
    CHECK_THAT(log, Contains("  scene: Beads in a box\n") && Contains("  frame: t ") && StartsWith("20"));
    CHECK(place.run(beads_in_a_box, "--log-file run.log").exit_code == 2);
    CHECK_THAT(place.read("run.log"), Contains("--force replaces it"));
}
