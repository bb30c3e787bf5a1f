// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double roller = 0.6;                               ///< speed of its surface [m/s]
const double fall = std::sqrt(0.3 * 0.3 + 2.0 * 9.81 * 0.3); ///< of a grain from the feed to the floor [m/s]

struct Nip {
    double fastest = 0.0; ///< of any grain in any step [m/s]
    double stored = 0.0;  ///< most in the contacts [J]
    int presses = 0, others = 0;
};

Nip run(Simulation& simulation, double time)
{
    Nip nip;
    const auto watch = [&](const StepReport& report) {
        nip.fastest = std::max(nip.fastest, report.bodies.fastest_speed);
        nip.stored = std::max(nip.stored, report.contacts.stored_energy);
        for (const Incident& incident : report.bodies.incidents)
            ++(incident.kind == Incident::Kind::pressed ? nip.presses : nip.others);
    };
    talus::run_until(simulation, time, {.after_step = watch});
    return nip;
}

} // namespace

TEST_CASE("5 a nip", "[hard]")
{
    // A roller on a floor grips the grains with which it is fed, up to an angle of 2 atan 0.8, and draws them into a
    // gap that closes altogether: they cannot win. What is pressed so must yield. Where it does not, its contacts store
    // more than a thousand joules, with which a grain that slips out is shot away at twenty metres a second and more;
    // but no grain can be faster than what falls onto a roller that turns.
    HardCase hard("5 a nip");
    for (const std::string law : {"matched", "projected"})
        for (const int seed : {1, 2, 3}) {
            auto simulation = open_scene("nip", {"solver.stabilisation=" + law, "seed=" + std::to_string(seed)});
            const Nip nip = run(simulation, 4.0);
            const std::string name = law + ", seed " + std::to_string(seed) + ": ";
            hard.below(name + "fastest grain [fall and roller]", nip.fastest / (fall + roller), 1.0);
            hard.holds(name + "presses are reported, and nothing else", nip.presses > 0 && nip.others == 0);
            hard.tell(name + "presses", nip.presses);
            hard.below(name + "most energy in the contacts [fall of all grains]", nip.stored / (1.6 * 9.81 * 0.3), 0.1);
            hard.tell(name + "grains drawn through", static_cast<double>(simulation.outflow.count));
        }
}
