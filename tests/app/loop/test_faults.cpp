// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "tests/app/program.hpp"
#include "tests/app/readme_table.hpp"
#include "tests/app/run_folder.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <functional>
#include <optional>
#include <vector>

namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace
{

/// What machines and people do to a run.
struct Fault {
    std::string text;
    std::string happens;   ///< shell commands that end with the exit code to tell; $RUN makes the run in `out`
    std::string mend = {}; ///< shell commands before the run is resumed
};

const std::string wait_for_checkpoints = "until [ -e out/checkpoint.previous ]; do sleep 0.002; done; ";
const std::string meanwhile = "$RUN & pid=$!; " + wait_for_checkpoints;

/// What the shell says of the kill is none of the program's sentences.
std::string killed()
{
    return "{ " + meanwhile + "kill -9 $pid; wait $pid; } 2> /dev/null; ";
}

/// The run is killed, something is done to its files, and it is resumed.
std::string between(const std::string& commands)
{
    return killed() + commands + "; $TALUS resume out --quiet --threads 1";
}

/// The next checkpoint does not come to its end, so that a second signal meets the program after the first. While one
/// is being written its file is in the way.
const std::string hold_checkpoints = "until mkfifo out/checkpoint.next.tmp 2> /dev/null; do :; done; ";

Fault second_signal(const std::string& signal)
{
    return {"SIG" + signal + " twice",
        meanwhile + hold_checkpoints + "kill -" + signal + " $pid; sleep 0.3; kill -" + signal + " $pid; wait $pid",
        "rm out/checkpoint.next.tmp"};
}

const std::vector<Fault> faults = {
    {"kill -9", killed() + "(exit $?)"},
    {"kill -9 before the first checkpoint",
        "{ $RUN --set checkpoint.interval=inf & pid=$!; until [ -e out/frames/particles_000001.vtp ]; do sleep 0.002; "
        "done; kill -9 $pid; wait $pid; } 2> /dev/null; (exit $?)"},
    {"SIGINT", meanwhile + "kill -INT $pid; wait $pid"},
    {"SIGTERM", meanwhile + "kill -TERM $pid; wait $pid"},
    {"a closed terminal", "env --default-signal=HUP " + meanwhile + "kill -HUP $pid; wait $pid"},
    {"a limit on CPU time", meanwhile + "kill -XCPU $pid; wait $pid"},
    second_signal("INT"),
    second_signal("TERM"),
    {"a crash of the program", meanwhile + "kill -SEGV $pid; wait $pid"},
    {"the folder is taken away", meanwhile + "mv out gone; wait $pid", "mv gone out"},
    {"the clock is set back, again and again", "LD_PRELOAD=" TALUS_CLOCK_SET_BACK " $RUN --log-file log"},
    {"a power cut between two renames of a checkpoint",
        between("rm out/checkpoint.latest; echo half > out/checkpoint.next.tmp")},
    {"a checkpoint that was cut short", between("truncate -s -1 out/checkpoint.latest")},
    {"a byte of a checkpoint flipped",
        between("printf U | dd of=out/checkpoint.latest bs=1 seek=3000 conv=notrunc status=none")},
    {"both checkpoints cut short", between("truncate -s -1 out/checkpoint.latest out/checkpoint.previous")},
    {"the mesh of a wall exchanged",
        between("mv out/files/cup.stl good.stl; sed s/-2/-3/ good.stl > out/files/cup.stl"),
        "mv good.stl out/files/cup.stl"},
    {"metrics.csv cut short", between("cp out/metrics.csv good.csv; truncate -s 100 out/metrics.csv"),
        "mv good.csv out/metrics.csv"},
};

/// On a disk of its own that has no room for the whole run, and then has.
const Fault full_disk = {"a disk that is full", "mkdir disk; mount -t tmpfs -o size=400k none disk; mkdir disk/out; ln "
                                                "-s disk/out out; $RUN; code=$?; rm out; cp -r disk/out out; "
                                                "umount disk; (exit $code)"};

/// From the second checkpoint on there is none.
const Fault no_memory = {
    "memory is used up", "export MEMORY_ENDS_WITH=out/checkpoint.previous; LD_PRELOAD=" TALUS_MEMORY_USED_UP " $RUN"};

const std::string cup = R"(solid
facet normal 0 0 1
outer loop
vertex 0 0 -2
vertex 1 0 -2
vertex 0 1 -2
endloop
endfacet
endsolid
)";

/// A second of beads, with a far wall from a mesh, and checkpoints all the while.
void write_scene(const Workplace& place)
{
    place.write("cup.stl", cup);
    place.write("scene.toml", stream_of_beads() +
                                  "[[wall]]\nname = \"cup\"\nmaterial = \"glass\"\nmesh = \"cup.stl\"\n[checkpoint]\n"
                                  "interval = 0.05\n");
}

const std::string run = "run scene.toml --threads 1 --until 2 --quiet";

std::string in_table(const std::string& text)
{
    return table_cell(as_shown(text, {{"^[^ ]*/cup.stl", "/…/cup.stl"}, {"^out/[^ ]*: cannot", "out/…: cannot"}}));
}

/// The folder of the run that nothing befalls.
fs::path whole()
{
    static const Workplace place;
    static const bool made = [] {
        write_scene(place);
        return place.talus(run + " -o whole").exit_code == 0;
    }();
    REQUIRE(made);
    return place.path("whole");
}

/// What a resumed run makes of what the fault has left.
std::string kept(const Workplace& place)
{
    const Outcome resumed = place.talus("resume out --threads 1");
    if (resumed.exit_code != 0) return fmt::format("frames and metrics; `{}`", in_table(resumed.err));
    CHECK_THAT(resumed.out, Contains("resumed from out/checkpoint."));
    const auto different = differences(whole(), place.path("out"));
    return different.empty() ? "all: resumed, the same bits" : "resumed, but different: " + different.front();
}

std::string row(const Fault& fault)
{
    INFO(fault.text);
    const Workplace place;
    write_scene(place);
    const Outcome outcome = place.shell("RUN=\"$TALUS " + run + " -o out\"; " + fault.happens);
    CHECK(line_of(outcome.err + "|", "|") <= 2);
    if (!fault.mend.empty()) REQUIRE(place.shell(fault.mend).exit_code == 0);
    const std::string sentence = in_table(outcome.err);
    return fmt::format("| {} | {} | {} | {} |\n", fault.text, outcome.exit_code,
        sentence.empty() ? "–" : "`" + sentence + "`", kept(place));
}

/// A run to kill; one that has spheres enough for it shares them among two threads.
struct Victim {
    std::string text;
    std::function<void(const Workplace&)> write = [](const Workplace&) {};
    std::string arguments; ///< of `talus run`, but for the folder
    std::string threads = "1";
};

const Victim beads_in_a_stream = {
    "a stream of beads through a funnel of walls and a mesh", write_scene, "scene.toml --until 2"};

const Victim beads_under_a_plate = {"beads under a loaded plate",
    [](const Workplace& place) { place.write("scene.toml", loaded_beads() + "[checkpoint]\ninterval = 0.05\n"); },
    "scene.toml --until 2"};

const Victim small_hopper = {
    .text = "two thousand beads in a hopper, on two threads",
    .arguments =
        "hopper --until 0.5 --set fill.0.count=2000 --set wall.gate.remove_at=0.2 --set checkpoint.interval=0.01",
    .threads = "2",
};

/// When the last checkpoint was written.
std::optional<fs::file_time_type> checkpoint_time(const Workplace& place)
{
    std::error_code none;
    const auto time = fs::last_write_time(place.path("out/checkpoint.latest"), none);
    return none ? std::nullopt : std::optional(time);
}

/// Kills a run, and every resumption of it, after random times until it comes to its end. Returns how often. However
/// busy the machine is, it gets there: where no checkpoint came between two kills, the next one waits twice as long.
int kill_until_it_ends(const Victim& victim, const Workplace& place, talus::Random& random)
{
    fs::remove_all(place.path("out"));
    double patience = 0.3;
    for (int kills = 0;; ++kills) {
        const bool resumable = place.exists("out/checkpoint.latest") || place.exists("out/checkpoint.previous");
        const std::string verb = resumable ? "resume out" : "run " + victim.arguments + " -o out --force";
        const auto before = checkpoint_time(place);
        const Outcome outcome = place.shell(fmt::format("timeout -s KILL {:.4f} $TALUS {} --quiet --threads {}",
            0.01 + patience * talus::uniform(random), verb, victim.threads));
        if (outcome.exit_code != 128 + 9) {
            INFO(outcome.err);
            CHECK(outcome.exit_code == 0);
            return kills;
        }
        patience = checkpoint_time(place) == before ? 2.0 * patience : 0.3;
    }
}

void kill_at_random(const Victim& victim, int wanted)
{
    INFO(victim.text);
    const Workplace place;
    victim.write(place);
    REQUIRE(place.talus("run " + victim.arguments + " --quiet --threads 1 -o whole").exit_code == 0);
    talus::Random random(6);
    int kills = 0, runs = 0;
    for (; kills < wanted; ++runs) {
        kills += kill_until_it_ends(victim, place, random);
        CHECK(differences(place.path("whole"), place.path("out")).empty());
    }
    WARN(victim.text << ": " << kills << " kills survived, in " << runs << " runs");
}

/// Two commands of random kinds and moments meet in one folder, a signal perhaps with them; then the run goes on to its
/// end. Returns whether the second came while the first had the folder.
bool meet_at_random(const Victim& victim, const Workplace& place, talus::Random& random)
{
    const std::string begin = "run " + victim.arguments + " -o out", resume = "resume out";
    const auto any_of = [&](const std::vector<std::string>& commands) {
        return commands[static_cast<std::size_t>(talus::uniform(random) * static_cast<double>(commands.size()))];
    };
    const bool resumable = place.exists("out/checkpoint.latest") && !place.exists("out/summary.json");
    const std::string first = resumable ? resume : begin + " --force";
    const std::string options = fmt::format(" --quiet --threads {}", victim.threads);
    const std::string signal = any_of({":", "kill -9 $first", "kill -INT $first", "kill -HUP $first"});
    const Outcome outcome = place.shell(
        fmt::format("{{ env --default-signal=HUP $TALUS {}{} & first=$!; sleep {:.4f}; $TALUS {}{}; echo $?; "
                    "sleep {:.4f}; {}; wait $first; }} 2> told; (exit 0)",
            first, options, 0.2 * talus::uniform(random), any_of({begin, begin + " --force", resume}), options,
            0.1 * talus::uniform(random), signal));
    CHECK((outcome.out == "0\n" || outcome.out == "2\n"));
    const bool met = place.read("told").find("writes into this folder") != std::string::npos;
    if (!place.exists("out/summary.json") || place.read("out/summary.json").find("interrupted") != std::string::npos) {
        const bool can_go_on = place.exists("out/checkpoint.latest");
        CHECK(place.talus((can_go_on ? resume : begin + " --force") + options).exit_code == 0);
    }
    CHECK(differences(place.path("whole"), place.path("out")) == std::vector<std::string>{});
    return met;
}

} // namespace

TEST_CASE("what befalls a run has an exit code and a sentence, and little is lost: tests/results/faults.md",
    "[app][faults][not under thread]")
{
    std::string table = "| fault | exit code | sentence | what was kept |\n| --- | --- | --- | --- |\n";
    for (const Fault& fault : faults) table += row(fault);
    check_readme_table("faults", table);
}

TEST_CASE("a full disk loses no checkpoint", "[app][faults]")
{
    const Workplace place;
    if (place.shell("mkdir try && mount -t tmpfs none try && umount try").exit_code != 0) {
        WARN("skipped: file systems can only be mounted by root");
        return;
    }
    const std::string told = row(full_disk);
    CHECK_THAT(told, Contains("| 4 | `out/…: cannot be written: No space left on device; "));
    CHECK_THAT(told, Contains("the last checkpoint in out is of t = … s; to go on: talus resume out"));
    CHECK_THAT(told, Contains("the same bits"));
}

TEST_CASE("where memory is used up, the last checkpoint is kept", "[app][faults]")
{
    const Workplace place;
    write_scene(place);
    if (place.shell("MEMORY_ENDS_WITH=. LD_PRELOAD=" TALUS_MEMORY_USED_UP " $TALUS check scene.toml").exit_code == 0) {
        WARN("skipped: this build brings a malloc of its own");
        return;
    }
    const std::string told = row(no_memory);
    CHECK_THAT(told, Contains("| 70 | `talus: there is not enough memory; the last "
                              "checkpoint in out is of t = … s; to go on: talus resume out` | all: resumed, the same"));
}

TEST_CASE("a run killed at random moments again and again ends with the same bits", "[app][faults]")
{
    kill_at_random(beads_in_a_stream, 5);
}

TEST_CASE("a run killed at a hundred random moments ends with the same bits", "[app][faults][slow]")
{
    for (const Victim& victim : {beads_in_a_stream, beads_under_a_plate, small_hopper}) kill_at_random(victim, 100);
}

TEST_CASE("under nohup a run outlives its terminal", "[app][faults]")
{
    const Workplace place;
    write_scene(place);
    const Outcome outcome = place.shell(
        "nohup $TALUS " + run + " -o out < /dev/null & pid=$!; " + wait_for_checkpoints + "kill -HUP $pid; wait $pid");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(place.read("out/summary.json"), Contains("\"done\""));
}

TEST_CASE("a run that was killed while its folder was made can be begun again", "[app][faults]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    REQUIRE(place.shell("mkdir out; echo half > out/scene.resolved.toml.tmp").exit_code == 0);
    CHECK(place.talus("run scene.toml -o out --quiet").exit_code == 0);
}

TEST_CASE("whatever commands meet in a folder, the run ends with the same bits", "[app][faults][slow]")
{
    const Workplace place;
    beads_in_a_stream.write(place);
    REQUIRE(place.talus("run " + beads_in_a_stream.arguments + " --quiet --threads 1 -o whole").exit_code == 0);
    talus::Random random(7);
    int met = 0;
    for (int pairs = 0; pairs < 100; ++pairs) met += meet_at_random(beads_in_a_stream, place, random);
    CHECK(met > 20);
}
