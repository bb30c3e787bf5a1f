// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace
{

std::vector<double> frame_times(const std::string& pvd)
{
    static const std::regex timestep("timestep=\"([^\"]*)\"");
    std::vector<double> times;
    for (std::sregex_iterator match(pvd.begin(), pvd.end(), timestep), end; match != end; ++match)
        times.push_back(std::stod((*match)[1]));
    return times;
}

std::vector<std::string> lines(const std::string& text)
{
    std::vector<std::string> all;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
}

} // namespace

TEST_CASE("the ledger of a run with pour and outlet closes", "[app][run]")
{
    const Workplace place;
    const Outcome outcome = place.run(stream_of_beads());
    REQUIRE(outcome.exit_code == 0);
    const json ledger = json::parse(place.read("out/summary.json"))["ledger"];
    CHECK(ledger["inserted"] == 8 + 20);
    CHECK(ledger["left"] > 8);
    CHECK(ledger["escaped"] == 0);
    CHECK(ledger["inside"].get<int>() + ledger["left"].get<int>() == 8 + 20);
    CHECK(ledger["closes"] == true);
    CHECK_THAT(outcome.out, Contains("28 inserted") && Contains("(closes)"));
}

TEST_CASE("beads that are poured gain no energy from what blows leave overlapping", "[app][run][energy]")
{
    // Three seeds gained 1e-4, 0 and 0 of what they lost; while such overlaps were springs, 5e-3, 4e-3 and 6e-4.
    const Workplace place;
    const std::string seed = std::to_string(GENERATE(1, 2, 3));
    REQUIRE(place.talus("run pile --until 0.5 --threads 1 -o out --set seed=" + seed).exit_code == 0);
    const json energy = json::parse(place.read("out/summary.json"))["error"]["energy"];
    CHECK(energy["lost"] > 0.8); // of some 1.3 J that beads bring in until then, a part of which they still have
    CHECK(energy["gained"] < 5e-4 * energy["lost"].get<double>());
}

TEST_CASE("the summary has the keys that scripts rely on", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(stream_of_beads(), "--seed 7").exit_code == 0);
    const json summary = json::parse(place.read("out/summary.json"));
    CHECK(summary["status"] == "done");
    CHECK(summary["scene"] == "scene");
    CHECK(summary["seed"] == 7);
    CHECK(summary["threads"] == 1);
    CHECK(summary["time"]["simulated"] == Approx(0.4).epsilon(0.01));
    const double counted = summary["time"]["step"].get<double>() * summary["time"]["steps"].get<double>();
    CHECK(summary["time"]["simulated"] == Approx(counted));
    CHECK(summary["error"]["residual"]["mean"] <= summary["error"]["residual"]["worst"]);
    CHECK(summary["error"]["overlap_d"]["mean"] <= summary["error"]["overlap_d"]["worst"]);
    CHECK(summary["timing"]["phases"].size() == 11);

    const json& flow = summary["sensors"]["drain"];
    REQUIRE(flow.size() >= 1);
    for (const json& quantity : flow) {
        CHECK(quantity["value"].is_number());
        CHECK(quantity.contains("spread"));
        CHECK(quantity["unit"].is_string());
    }
}

TEST_CASE("the phases add up to the whole time of a run", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    const json timing = json::parse(place.read("out/summary.json"))["timing"];
    double wall = 0.0;
    for (const json& phase : timing["phases"]) wall += phase["wall"].get<double>();
    CHECK(timing["wall"] == Approx(wall));
    CHECK(timing["phases"]["sweeps"]["wall"] > 0.0);
}

TEST_CASE("frames and rows come at the first step at or after their due time, without drift", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    const double step = json::parse(place.read("out/summary.json"))["time"]["step"];
    const auto times = frame_times(place.read("out/particles.pvd"));
    const auto rows = lines(place.read("out/metrics.csv"));
    REQUIRE(times.size() == 6);
    REQUIRE(rows.size() == 1 + 6);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double due = 0.01 * static_cast<double>(k);
        CHECK(times[k] >= due - 1e-9);
        CHECK(times[k] < due + step);
        CHECK(std::stod(rows[1 + k]) <= due + step * (1 + 1e-9)); // the first row is that of the first step
    }
}

TEST_CASE("metrics.csv names each column with its unit, sensors included", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(stream_of_beads()).exit_code == 0);
    const auto rows = lines(place.read("out/metrics.csv"));
    CHECK_THAT(rows.at(0), StartsWith("time_s,spheres,inserted,left,contacts,sweeps,residual,worst_overlap_d,"));
    CHECK_THAT(rows.at(0), Contains("kinetic_energy_J") && Contains(",drain_") && !Contains("/"));
    const auto columns = std::count(rows[0].begin(), rows[0].end(), ',');
    for (const std::string& row : rows) CHECK(std::count(row.begin(), row.end(), ',') == columns);
}

TEST_CASE("a run writes the results of its sensors, and profiles as tables", "[app][run]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box + R"([[sensor]]
name = "bed"
kind = "region"
region = { max = [0.05, 0.05, 0.05] }
[[sensor]]
name = "load"
kind = "wall_force"
wall = "tray"
[[sensor]]
name = "rise"
kind = "profile"
direction = "z"
bins = 5
region = { max = [0.05, 0.05, 0.05] }
)");
    REQUIRE(outcome.exit_code == 0);
    const json sensors = json::parse(place.read("out/summary.json"))["sensors"];
    // Eight beads of 10 mm in 125 cm³.
    CHECK(sensors["bed"]["packing_fraction"]["value"] == Approx(8 * 0.5236 / 125.0).epsilon(1e-3));
    CHECK(sensors["load"]["force_z"]["value"] < 0.0);
    CHECK(sensors["rise"]["packing_fraction"]["value"] == Approx(8 * 0.5236 / 125.0).epsilon(1e-3));
    CHECK_THAT(place.read("out/metrics.csv"), Contains(",bed_stress_zz_Pa,") && Contains(",load_torque_x_N_m,"));
    const auto table = lines(place.read("out/profile_rise.csv"));
    REQUIRE(table.size() == 1 + 5);
    CHECK_THAT(table[0], StartsWith("position_m,packing_fraction,packing_fraction_error,velocity_x_m_per_s,"));
    CHECK_THAT(table[1], StartsWith("0.005,"));
}

TEST_CASE("a wall that is taken away gives a new wall frame", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(replaced(beads_in_a_box, "name = \"tray\"", "name = \"tray\"\nremove_at = 0.03")).exit_code == 0);
    const auto times = frame_times(place.read("out/walls.pvd"));
    REQUIRE(times.size() == 2);
    CHECK(times[0] == 0.0);
    CHECK(times[1] == Approx(0.03).margin(1e-3));
}

TEST_CASE("a wall that appears inside spheres is reported, and the run goes on", "[app][run]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box + R"([[wall]]
name = "plate"
shape = "disk"
center = [0.025, 0.025, 0.006]
radius = 0.05
material = "glass"
appear_at = 0.03
)");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("s: the wall 'plate' appears inside ") && Contains("; they are pushed out"));
}

TEST_CASE("contact frames are written at the first and the last step unless more are asked for", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    CHECK(frame_times(place.read("out/contacts.pvd")).size() == 2);
    REQUIRE(place.run(beads_in_a_box, "--force --set output.contact_interval=0.01").exit_code == 0);
    CHECK(frame_times(place.read("out/contacts.pvd")).size() == 6);
}

TEST_CASE("a pour that falls short says why", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(stream_of_beads(), "--set pour.source.count=1000").exit_code == 0);
    const std::string late = json::parse(place.read("out/summary.json"))["pours"][0]["shortfall"];
    CHECK_THAT(late, Contains("ended before"));
    REQUIRE(
        place.run(stream_of_beads(), "--force --set pour.source.count=1000 --set pour.source.rate=1e5").exit_code == 0);
    const std::string full = json::parse(place.read("out/summary.json"))["pours"][0]["shortfall"];
    CHECK_THAT(full, Contains("no free place"));
    REQUIRE(place.run(stream_of_beads(), "--force --set pour.source.count=0 --set pour.source.mass=10").exit_code == 0);
    const json by_mass = json::parse(place.read("out/summary.json"))["pours"][0];
    CHECK(by_mass["asked"].is_null());
    CHECK(by_mass["asked_mass"] == 10.0);
    CHECK(by_mass["poured_mass"] > 0.0);
    CHECK_THAT(by_mass["shortfall"].get<std::string>(), Contains("ended before"));
}

TEST_CASE("the resolved scene runs again to the same metrics", "[app][run]")
{
    const Workplace place;
    REQUIRE(place.run(stream_of_beads(), "--set contact.glass-glass.friction=0.3 --until 0.2").exit_code == 0);
    REQUIRE(place.talus("run out/scene.resolved.toml -o again --threads 1").exit_code == 0);
    CHECK(place.read("again/metrics.csv") == place.read("out/metrics.csv"));
}

TEST_CASE("a quiet run prints nothing, a verbose one a line for every frame and checkpoint", "[app][run]")
{
    const Workplace place;
    const Outcome quiet = place.run(beads_in_a_box, "--quiet");
    CHECK(quiet.exit_code == 0);
    CHECK(quiet.out + quiet.err == "");
    const Outcome verbose = place.run(beads_in_a_box, "--force --verbose");
    CHECK(lines(verbose.err).size() == 5 + 1); // and one for the checkpoint before the last step
    CHECK_THAT(verbose.err, StartsWith("frame: t "));
}

TEST_CASE("a run says how far the relaxation got", "[app][run]")
{
    const Workplace place;
    const Outcome outcome = place.run(beads_in_a_box, "--relax");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("relaxed in 0 steps: 0 overlaps"));
}

TEST_CASE("momentum comes from gravity and walls, and hardly any is left over", "[app][run]")
{
    const std::string law = GENERATE("matched", "projected");
    const std::string piston = GENERATE("", R"(
[[wall]]
name = "lid"
shape = "box"
min = [0.001, 0.001, 0.06]
max = [0.049, 0.049, 0.07]
material = "glass"
mass = 0.1
guide = [0, 0, -1]
)");
    CAPTURE(law, piston);
    const Workplace place;
    const Outcome outcome = place.run(
        beads_in_a_box + piston, "--until 0.2 --set contact.0.rolling_friction=0.1 --set solver.stabilisation=" + law);
    REQUIRE(outcome.exit_code == 0);
    const auto error = nlohmann::json::parse(place.read("out/summary.json"))["error"];
    const double weight = 0.01047 * 9.81;
    CHECK(error["momentum"]["from_gravity"] == Approx(0.2 * weight).epsilon(0.01));
    CHECK(error["momentum"]["from_walls"] > 0.1 * weight);
    CHECK(error["momentum"]["left_over"] < 1e-13 * weight);
    CHECK(error["angular_momentum"]["left_over"] < (law == "matched" ? 1e-15 : 1e-8) * weight);
}
