// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/error_looks.hpp"

#include "app/loop/open_scene.hpp"
#include "core/step/diagnostics.hpp"
#include "tests/app/program.hpp"
#include "tests/app/run_folder.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <map>

using namespace talus;

namespace
{

/// A hundred beads that fall into a box and lie there after about 0.3 s; a sensor watches the force on the box.
std::string bed_in_a_box(const std::string& duration)
{
    std::string scene = replaced(beads_in_a_box, "count = 8", "count = 100");
    for (const char* end : {"max = [0.05, 0.05, 0.05] }", "max = [0.05, 0.05, 0.05]\n"}) // of the fill, of the box
        scene = replaced(scene, end, replaced(end, "0.05]", "0.15]"));
    return replaced(scene, "duration = 0.05", "duration = " + duration) +
           "[[sensor]]\nname = \"tray\"\nkind = \"wall_force\"\nwall = \"tray\"\n";
}

Simulation open(const Workplace& place, const std::vector<std::string>& overrides)
{
    place.write("scene.toml", bed_in_a_box("0.5"));
    SceneRequest request;
    request.scene = place.path("scene.toml");
    request.overrides = overrides;
    return open_scene(request).simulation;
}

std::string bytes_of(Simulation& simulation)
{
    Archive archive;
    archive(simulation);
    return archive.bytes();
}

/// By id.
std::map<std::int64_t, Vec3> velocities(const State& state)
{
    std::map<std::int64_t, Vec3> all;
    for (std::size_t i = 0; i < state.count(); ++i) all[state.id[i]] = state.body(i).velocity;
    return all;
}

/// The velocity error of the next step without any of what looks are made with: the simulation is stored, makes the
/// step in both ways, and is put back. [m/s]
double true_velocity_error(Simulation& simulation)
{
    const std::string before = bytes_of(simulation);
    const auto put_back = [&] {
        Archive archive(before);
        archive(simulation);
    };
    const SolverSettings usual = simulation.model.solver;
    advance(simulation);
    const auto found = velocities(simulation.state);
    put_back();
    simulation.model.solver.tolerance = 1e-12;
    simulation.model.solver.max_sweeps = 20000;
    advance(simulation);
    double squares = 0.0;
    for (const auto& [id, v] : velocities(simulation.state)) squares += (found.at(id) - v).squaredNorm();
    simulation.model.solver = usual;
    put_back();
    return std::sqrt(squares / static_cast<double>(found.size()));
}

} // namespace

TEST_CASE("looks see the velocity error that a step has, be it large or small", "[app][error_looks]")
{
    // Far too long a step that is hardly solved, what a scene gets that asks for nothing, and one that is solved well.
    const Workplace place;
    const auto [overrides, least, most] = GENERATE(table<std::vector<std::string>, double, double>({
        {{"time.step=0.0018", "solver.tolerance=0.5"}, 0.05, 1.0},
        {{}, 0.001, 0.1},
        {{"solver.tolerance=1e-9", "solver.max_sweeps=20000"}, 0.0, 1e-6},
    }));
    Simulation simulation = open(place, overrides);
    ErrorLooks looks;
    // Few steps must do; and where these are solved well, to go further costs as much.
    looks.set_share(most == 1e-6 ? 20.0 : ErrorLooks::large_share);
    std::map<double, double> true_errors; // by time
    while (!has_reached(simulation, simulation.duration)) {
        looks.before_step(simulation);
        const bool is_open = looks.is_open();
        const double error = is_open ? true_velocity_error(simulation) : 0.0;
        looks.after_step(simulation, advance(simulation));
        if (is_open) true_errors[simulation.state.time] = error;
    }
    const SolverErrorSummary summary = looks.summary(simulation.model);
    REQUIRE(summary.looks >= 3);
    double truth = 0.0;
    for (const ErrorLook& look : looks.looks()) truth += std::pow(true_errors.at(look.time), 2);
    truth = std::sqrt(truth / static_cast<double>(summary.looks));
    INFO("true " << truth << " m/s, found " << summary.velocity_error << " m/s, " << summary.looks << " looks");
    CHECK(summary.velocity_error == Approx(truth).epsilon(0.2).margin(1e-12));
    CHECK(summary.of_contacts >= least);
    CHECK(summary.of_contacts <= most);
    CHECK(summary.worst_velocity_error >= summary.velocity_error);
}

TEST_CASE("the error of the force on a wall is what is missing of the weight that it bears", "[app][error_looks]")
{
    // A bed at rest whose impulses are forgotten, and get three sweeps to come back: the floor bears part of the
    // weight.
    const Workplace place;
    Simulation simulation = open(place, {});
    ErrorLooks looks;
    looks.set_share(20.0);
    StepReport report;
    const auto step = [&] {
        looks.before_step(simulation);
        report = advance(simulation);
        looks.after_step(simulation, report);
    };
    while (!has_reached(simulation, simulation.duration)) step();
    double weight = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i)
        weight += simulation.state.mass(i) * simulation.model.gravity.norm();

    const auto wait = [&] { // up to the step to look at next
        for (looks.before_step(simulation); !looks.is_open(); looks.before_step(simulation))
            looks.after_step(simulation, advance(simulation));
    };
    wait();
    step();
    const ErrorLook rest = looks.looks().back();
    REQUIRE(rest.wall_forces.size() == 1);
    CHECK(rest.wall_forces[0] == Approx(weight).epsilon(0.02)); // what still moves presses a little more or less
    CHECK(rest.wall_errors[0] < 0.02 * weight);
    CHECK(rest.force_error < 0.2);

    wait();
    for (Tile& tile : simulation.network.list.tiles.tiles) tile.carried.scale(0.0);
    simulation.network.carried.walls.scale(0.0);
    looks.before_step(simulation); // with the state as it is now
    REQUIRE(looks.is_open());
    simulation.model.solver.max_sweeps = 3;
    report = advance(simulation);
    looks.after_step(simulation, report);
    const double found = report.wall_loads[0].impulse.norm() / simulation.model.time_step;
    const ErrorLook cold = looks.looks().back();
    INFO("weight " << weight << " N, floor after three sweeps " << found << " N");
    REQUIRE(found < 0.8 * weight);
    CHECK(cold.wall_forces[0] == Approx(weight).epsilon(0.05));
    CHECK(cold.wall_errors[0] == Approx(weight - found).epsilon(0.1));
    CHECK(cold.force_error > rest.force_error);
}

TEST_CASE("a run that is looked at has the bits of one that is not", "[app][error_looks][determinism]")
{
    const Workplace place;
    Simulation plain = open(place, {}), watched = open(place, {});
    ErrorLooks looks;
    looks.set_share(5.0);
    for (int k = 0; k < 700; ++k) {
        advance(plain);
        looks.before_step(watched);
        looks.after_step(watched, advance(watched));
    }
    REQUIRE(looks.looks().size() > 5);
    CHECK(bytes_of(watched) == bytes_of(plain));
}

TEST_CASE("--error-estimate changes only what a run says of its error", "[app][error_looks][determinism]")
{
    const Workplace place;
    place.write("scene.toml", bed_in_a_box("0.2"));
    REQUIRE(place.talus("run scene.toml --quiet -o plain --threads 1").exit_code == 0);
    REQUIRE(place.talus("run scene.toml --quiet -o closer --threads 2 --error-estimate").exit_code == 0);
    CHECK(differences(place.path("plain"), place.path("closer")) ==
          std::vector<std::string>{"checkpoint.latest", "metrics.csv", "summary.json"});

    auto plain = nlohmann::json::parse(place.read("plain/summary.json"));
    auto closer = nlohmann::json::parse(place.read("closer/summary.json"));
    CHECK(closer["error"]["solver"]["made"] > plain["error"]["solver"]["made"]);
    CHECK(closer["error"]["solver"]["velocity"]["of_contacts"] > 0.0);
    CHECK(closer["error"]["solver"]["wall_forces"].contains("tray"));
    for (auto* summary : {&plain, &closer}) {
        summary->erase("timing");
        summary->erase("threads");
        for (const char* of_error : {"solver", "companions"}) (*summary)["error"].erase(of_error);
        for (auto& quantity : (*summary)["sensors"]["tray"])
            for (const char* by : {"step", "solver"}) quantity.erase(by);
    }
    CHECK(plain == closer);

    // in metrics.csv the columns of looks alone
    std::istringstream one(place.read("plain/metrics.csv")), other(place.read("closer/metrics.csv"));
    std::string header, line, other_line;
    std::getline(one, header);
    std::getline(other, line);
    REQUIRE(line == header);
    const auto fields = [](const std::string& text) {
        std::vector<std::string> list;
        std::istringstream stream(text);
        for (std::string field; std::getline(stream, field, ',');) list.push_back(field);
        return list;
    };
    const auto names = fields(header);
    std::size_t rows = 0, looked = 0;
    while (std::getline(one, line) && std::getline(other, other_line)) {
        const auto a = fields(line), b = fields(other_line);
        for (std::size_t k = 0; k < names.size(); ++k) {
            if (names[k].find("_error") == std::string::npos) CHECK(a[k] == b[k]);
            if (names[k] == "velocity_error_of_contacts" && b[k] != "nan") ++looked;
        }
        ++rows;
    }
    CHECK(rows > 10);
    CHECK(looked > 1);
}

TEST_CASE("looks that were stored go on as if nothing had been, and are spread over a long run", "[app][error_looks]")
{
    const Workplace place;
    Simulation simulation = open(place, {"fill.0.count=8"});
    ErrorLooks whole, parts;
    for (int k = 0; k < 9000; ++k) {
        for (ErrorLooks* looks : {&whole, &parts}) looks->before_step(simulation);
        const StepReport report = advance(simulation);
        for (ErrorLooks* looks : {&whole, &parts}) looks->after_step(simulation, report);
        if (k % 1000 != 500) continue;
        Archive stored;
        parts.persist(stored);
        Archive archive(stored.bytes());
        parts = ErrorLooks();
        parts.persist(archive);
        REQUIRE(archive.at_end());
    }
    Archive one, other;
    whole.persist(one);
    parts.persist(other);
    CHECK(one.bytes() == other.bytes());

    const auto& looks = whole.looks();
    REQUIRE(looks.size() >= 15);
    CHECK(looks.size() < 240);
    const double h = simulation.model.time_step;
    const double usual = (looks.back().time - looks.front().time) / static_cast<double>(looks.size() - 1);
    CHECK(looks.front().time < 0.1 + usual); // they have fallen by then
    CHECK(looks.back().time > 9000 * h - 2.0 * usual);
    for (std::size_t k = 1; k < looks.size(); ++k) CHECK(looks[k].time - looks[k - 1].time < 3.0 * usual);
    for (const ErrorLook& look : looks) CHECK(look.wall_forces.size() == 1);
}

TEST_CASE("a run that is too short to be looked at says so", "[app][error_looks]")
{
    const Workplace place;
    const Outcome outcome = place.run(replaced(beads_in_a_box, "duration = 0.05", "duration = 0.01"));
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Catch::Matchers::Contains("the run was too short to look at it"));
    const auto solver = nlohmann::json::parse(place.read("out/summary.json"))["error"]["solver"];
    CHECK(solver["looks"] == 0);
    CHECK(solver["velocity"]["error"].is_null());
}
