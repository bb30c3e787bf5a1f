// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"
#include "tests/app/run_folder.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;

TEST_CASE(
    "a sphere that escapes ends the run with 3, and is reported with id, speed and the wall it left", "[app][guard]")
{
    const Workplace place;
    const Outcome outcome = place.run(bead_on_a_table);
    CHECK(outcome.exit_code == 3);
    CHECK_THAT(outcome.err, Contains("sphere 0 ") && Contains("outlet") && Contains("m/s") && Contains("'table'"));
    CHECK_THAT(outcome.out, Contains("FAILED"));

    const auto summary = nlohmann::json::parse(place.read("out/summary.json"));
    CHECK(summary["status"] == "failed");
    CHECK(summary["ledger"]["escaped"] == 1);
    CHECK(summary["ledger"]["inside"] == 0);
    CHECK(summary["ledger"]["closes"] == true);
    const auto& incident = summary["incidents"].at(0);
    CHECK(incident["kind"] == "escaped");
    CHECK(incident["last_wall"] == "table");

    // It stopped in the step in which it happened: a step before, the bead was still above the world's lower face.
    const double below = -0.05 - incident["position"][2].get<double>();
    const double one_step = summary["time"]["step"].get<double>() * incident["speed"].get<double>();
    const double beside = incident["position"][0].get<double>() - 0.08;
    CHECK(std::max(below, beside) >= 0.0);
    CHECK(std::max(below, beside) <= one_step);
}

TEST_CASE("a run that failed can go on where it can be mended, as if it had been so from the start", "[app][guard]")
{
    const Workplace place;
    const std::string mended = " --set world.on_escape=remove";
    REQUIRE(place.run(bead_on_a_table).exit_code == 3);
    const std::string rows = place.read("out/metrics.csv");
    CHECK(place.talus("resume out --quiet").exit_code == 3); // nothing was mended
    CHECK(place.read("out/metrics.csv") == rows);
    CHECK(place.talus("resume out --quiet" + mended).exit_code == 0);
    REQUIRE(place.talus("run scene.toml -o mended --threads 1 --quiet" + mended).exit_code == 0);
    CHECK(differences(place.path("mended"), place.path("out")).empty());
}

TEST_CASE("an escape loses no frame, and adds one of the step in which it happened", "[app][guard]")
{
    const Workplace place;
    REQUIRE(place.run(bead_on_a_table).exit_code == 3);
    const auto summary = nlohmann::json::parse(place.read("out/summary.json"));
    const double end = summary["time"]["simulated"];
    const auto frames = static_cast<int>(end / 0.05) + 2; // at 0, 0.05, … and at the end

    const std::string list = place.read("out/particles.pvd");
    for (int k = 0; k < frames; ++k) {
        const std::string frame = "frames/particles_00000" + std::to_string(k) + ".vtp";
        CHECK(place.exists("out/" + frame));
        CHECK_THAT(list, Contains(frame));
    }
    const std::string metrics = place.read("out/metrics.csv");
    const std::string last = metrics.substr(metrics.rfind('\n', metrics.size() - 2) + 1);
    CHECK(std::stod(last) == Approx(end));
}

TEST_CASE("with on_escape = \"remove\" a sphere that escapes is taken out, kept in lost.vtp and told", "[app][guard]")
{
    const Workplace place;
    const Outcome outcome = place.run(bead_on_a_table, "--set world.on_escape=remove --set time.duration=0.3");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("sphere 0 ") && Contains("it is taken out") && Contains("'table'"));
    CHECK(line_of(outcome.err + "|", "|") == 2); // once

    const auto summary = nlohmann::json::parse(place.read("out/summary.json"));
    CHECK(summary["status"] == "done");
    CHECK(summary["time"]["simulated"] == Approx(0.3).epsilon(0.01));
    CHECK(summary["ledger"]["escaped"] == 1);
    CHECK(summary["ledger"]["inside"] == 0);
    CHECK(summary["ledger"]["closes"] == true);
    CHECK_THAT(place.read("out/lost.vtp"), Contains("NumberOfPoints=\"1\"") && Contains("Name=\"last_wall\""));
}

TEST_CASE(
    "a press that closes on a rigid sphere stops the run, or is reported once where the scene goes on", "[app][guard]")
{
    const std::string press = bead_on_a_table + R"([[wall]]
name = "lid"
shape = "disk"
material = "glass"
center = [0.0, 0.0, 0.0105]
radius = 0.03
[[wall.motion]]
kind = "translate"
velocity = [0.0, 0.0, -0.01]
to = 0.11
[[wall.motion]]
kind = "translate"
velocity = [0.0, 0.0, 0.01]
from = 0.11
)";
    const std::string still = "--set solver.stabilisation=projected --set 'fill.0.velocity=[0, 0, 0]' --until 0.3";
    const Workplace place;
    const Outcome stopped = place.run(press, still);
    CHECK(stopped.exit_code == 3);
    CHECK_THAT(stopped.err, Contains("sphere 0 ") && Contains("pressed") && Contains("'table'") && Contains("'lid'"));
    const auto summary = nlohmann::json::parse(place.read("out/summary.json"));
    const auto& incident = summary["incidents"].at(0);
    CHECK(incident["kind"] == "pressed");
    CHECK(incident["spheres"] == nlohmann::json{0});
    CHECK(incident["walls"] == nlohmann::json{"table", "lid"});

    const Workplace other;
    const Outcome gone_on = other.run(press, still + " --set solver.on_no_solution=go_on");
    CHECK(gone_on.exit_code == 0);
    CHECK_THAT(gone_on.err, Contains("sphere 0 ") && Contains("'lid'; they yield"));
    CHECK(line_of(gone_on.err + "|", "|") == 2); // once
}

TEST_CASE("steps that are split are reported once, with what asked for it and the step that would do", "[app][guard]")
{
    // The bead flies up and down between the table and a lid, 1.1 d in a step.
    std::string scene = replaced(bead_on_a_table, "velocity = [0.5, 0.0, 0.0]", "velocity = [0.0, 0.0, 5.0]");
    scene = replaced(scene, "friction = 0.1", "friction = 0.0\nrestitution = 1.0");
    scene += "[[wall]]\nname = 'lid'\nshape = 'disk'\nmaterial = 'glass'\n"
             "center = [0.0, 0.0, 0.05]\nnormal = [0.0, 0.0, 1.0]\nradius = 0.03\n";
    const Workplace place;
    const Outcome outcome = place.run(scene, "--set time.step=0.0022 --until 0.5");
    CHECK_THAT(outcome.err,
        Contains("10 steps have been split") && Contains("sphere 0 and the wall '") && Contains("--set time.step="));
    CHECK(outcome.err.find("have been split") == outcome.err.rfind("have been split"));
    const auto summary = nlohmann::json::parse(place.read("out/summary.json"));
    CHECK(summary["error"]["sub_steps"]["most"] > 1);
    CHECK_THAT(summary["error"]["sub_steps"]["asked_by"], Contains("sphere 0 and the wall '"));
}
