// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy_books.hpp"
#include "hard_case.hpp"

#include "core/step/diagnostics.hpp"
#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

/// What the energy did over a run: kinetic, potential above that of all spheres on the floor, and stored in contacts.
/// It is that of the books, METHOD (energy), which free flight keeps in steps: T − Σ m g·(x − h v/2).
struct EnergyRecord {
    double start = 0.0;
    double kinetic_at_end = 0.0;
    double above_start = -infinity; ///< most that it was above the start
    double rises = 0.0;             ///< of all steps together, but for what pushing out and moves of positions put in
    double worst_rise = 0.0;        ///< in one step
    std::size_t at_cap = 0;         ///< steps that ended unconverged
};

EnergyRecord watch_energy(Simulation simulation)
{
    double floor = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i)
        floor += simulation.state.mass(i) * -simulation.model.gravity.z() * simulation.state.radius[i];
    const auto flight = [&] { return energy_of_flight(simulation.state, simulation.model) - floor; };
    EnergyRecord record;
    record.start = flight();
    EnergyBooks books(record.start);
    while (!has_reached(simulation, simulation.duration)) {
        const auto report = advance(simulation);
        REQUIRE(report.bodies.incidents.empty());
        record.at_cap += !report.solve.converged;
        const double rise = books.enter(report, flight());
        record.rises += rise;
        record.worst_rise = std::max(record.worst_rise, rise);
        record.above_start = std::max(record.above_start, books.complete() - record.start);
    }
    record.kinetic_at_end = kinetic_energy(simulation.state);
    return record;
}

} // namespace

TEST_CASE("20 energy of 2000 spheres dropped in a closed box", "[hard]")
{
    // Every step takes energy: kinetic, potential and stored in the contacts together. First-order steps give back what
    // the turn of a flight costs (m g h V an impact) and take it in the flight, so the energy to look at is the one
    // that flight keeps. Impulses short of their tolerance and Newton's law with friction may add a trace in a step;
    // what counts is that all of that together stays a trace, and E never passes its start.
    HardCase hard("20 energy of 2000 spheres dropped in a closed box");
    for (const char* e : {"0", "0.9"}) {
        const bool rebounds = std::string(e) != "0";
        const auto record =
            watch_energy(open_scene("closed_box", {std::string("contact.glass-glass.restitution=") + e}));
        const std::string which = std::string("e = ") + e + ": ";
        hard.below(which + "energy above that at the start [of it]", record.above_start / record.start, 1e-6);
        hard.below(which + "largest rise in a step [start]", record.worst_rise / record.start, 1e-6);
        hard.below(which + "all rises together [start]", record.rises / record.start, rebounds ? 1e-2 : 1e-4);
        hard.below(
            which + "kinetic energy at the end [start]", record.kinetic_at_end / record.start, rebounds ? 0.1 : 1e-4);
        hard.tell(which + "steps that ended at the cap of sweeps", static_cast<double>(record.at_cap));
    }
}
