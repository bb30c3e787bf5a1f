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

namespace
{

/// A run into `out` that goes on until a signal stops it, and what comes to its folder meanwhile. Returns what they
/// said.
Outcome while_it_runs(
    const Workplace& place, const std::string& commands, const std::string& settings = "--set checkpoint.interval=0.1")
{
    place.write("scene.toml", replaced(beads_in_a_box, "duration = 0.05", "duration = 1e4"));
    return place.shell("$TALUS run scene.toml -o out --threads 1 " + settings +
                       " --quiet & pid=$!; echo $pid > pid; until [ -e out/talus.lock ]; do sleep "
                       "0.005; done; sleep 0.2; " +
                       commands + "; kill -INT $pid; wait $pid");
}

} // namespace

TEST_CASE("a folder has one owner; who comes second reads who that is, and changes nothing", "[app][output]")
{
    const Workplace place;
    const Outcome outcome = while_it_runs(place,
        "$TALUS resume out; echo $?; $TALUS run scene.toml -o out; echo $?; $TALUS run scene.toml -o out --force; echo "
        "$?");
    CHECK(outcome.exit_code == 128 + 2);
    CHECK(outcome.out == "2\n2\n2\n");
    const std::string owner = "out: process " + replaced(place.read("pid"), "\n", "") + " on ";
    CHECK(outcome.err.find(owner) != outcome.err.rfind(owner)); // of resume and of --force
    CHECK_THAT(outcome.err, Contains("the folder holds a run already") && Contains("nothing was changed"));
    CHECK_FALSE(place.exists("out/talus.lock"));

    const std::string rows = place.read("out/metrics.csv");
    CHECK(rows.find('\0') == std::string::npos);
    CHECK(place.talus("resume out --quiet --until 1e-3").exit_code == 2); // it is beyond, and the folder is free
    CHECK(place.read("out/metrics.csv") == rows);
}

TEST_CASE("a folder has its owner though its lock file is removed, and gets the file back", "[app][output]")
{
    const Workplace place;
    const Outcome outcome = while_it_runs(place,
        "rm out/talus.lock; $TALUS resume out; echo $?; $TALUS run scene.toml -o out --force; echo $?; sleep 0.3; cat "
        "out/talus.lock");
    CHECK(outcome.exit_code == 128 + 2);
    CHECK(outcome.out.substr(0, 4) == "2\n2\n");
    CHECK_THAT(outcome.out, Contains("process " + replaced(place.read("pid"), "\n", "") + " on "));
    CHECK_THAT(outcome.err, Contains("writes into this folder") && Contains("nothing was changed"));
    CHECK_FALSE(place.exists("out/talus.lock"));
    CHECK(place.talus("resume out --quiet --until 1e-3").exit_code == 2); // it is beyond, and the folder is free
}

TEST_CASE("a run stops where its folder is taken away, and leaves another that stands there alone", "[app][output]")
{
    const Workplace place;
    const Outcome outcome = while_it_runs(place, "mv out away; mkdir out; sleep 0.5",
        "--set checkpoint.interval=5 --set time.frame_interval=5 --set "
        "time.metrics_interval=5");
    CHECK(outcome.exit_code == 4);
    CHECK_THAT(outcome.err, Contains("out: the folder was removed or moved"));
    CHECK(place.shell("ls out").out.empty());
}

TEST_CASE("--force replaces no file that the run is made from", "[app][output]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    REQUIRE(place.talus("run scene.toml -o out --quiet").exit_code == 0);
    const std::string resolved = place.read("out/scene.resolved.toml"),
                      frame = place.read("out/frames/particles_000000.vtp");
    const std::string fill =
        "count = 8\ndiameter = 0.01\nregion = { shape = \"box\", min = [0, 0, 0], max = [0.05, 0.05, 0.05] }";
    place.write("again.toml",
        replaced(beads_in_a_box, fill, "arrangement = \"file\"\nfile = \"out/frames/particles_000000.vtp\""));
    for (const std::string command :
        {"run out/scene.resolved.toml -o out --quiet --force", "run again.toml -o out --quiet --force",
            "dump out/scene.resolved.toml --at 0.02 --quiet --force -o out/scene.resolved.toml"}) {
        INFO(command);
        CHECK(place.talus(command).exit_code == 2);
        CHECK(place.read("out/scene.resolved.toml") == resolved);
        CHECK(place.read("out/frames/particles_000000.vtp") == frame);
    }
    CHECK(place.talus("run again.toml -o other --quiet").exit_code == 0);
}

TEST_CASE("what was killed owns its folder no more", "[app][output]")
{
    const Workplace place;
    const Outcome killed = while_it_runs(place, "kill -9 $pid");
    REQUIRE(place.exists("out/talus.lock"));
    CHECK(place.talus("run scene.toml -o out --force --quiet --until 0.02").exit_code == 0);
    CHECK_FALSE(place.exists("out/talus.lock"));
}

TEST_CASE("files that are there already are replaced with --force only", "[app][output]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    for (const std::string command :
        {"dump scene.toml --at 0.02 -o ", "solve step.hdf5 -o ", "solve step.hdf5 --history "}) {
        INFO(command);
        place.write("mine", "ten years of work");
        CHECK(place.talus(command + "mine --quiet").exit_code == 2);
        CHECK(place.read("mine") == "ten years of work");
        CHECK(place.talus(command + "mine --quiet --force").exit_code == 0);
        CHECK(place.read("mine") != "ten years of work");
        if (!place.exists("step.hdf5")) REQUIRE(place.shell("cp mine step.hdf5").exit_code == 0);
    }
}

TEST_CASE("a log goes on with a log, and with nothing else", "[app][output]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    const std::string run = "run scene.toml --force --log-file ";
    CHECK(place.talus(run + "log").exit_code == 0);
    const std::string once = place.read("log");
    CHECK(place.talus(run + "log").exit_code == 0);
    CHECK_THAT(place.read("log"), Catch::Matchers::StartsWith(once) && !Catch::Matchers::Equals(once));
    CHECK(place.talus(run + "scene.toml").exit_code == 2);
    CHECK(place.read("scene.toml") == beads_in_a_box);
}
