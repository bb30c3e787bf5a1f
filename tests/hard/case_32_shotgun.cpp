// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double edge = 0.2; // of the box [m]

/// How deep the deepest centre is behind a face of the box; negative while all are inside [m].
double deepest_outside(const State& state)
{
    double deepest = -infinity;
    for (const Vec3& x : state.position) deepest = std::max({deepest, -x.minCoeff(), x.maxCoeff() - edge});
    return deepest;
}

} // namespace

TEST_CASE("32 a shotgun in a closed box", "[hard]")
{
    // 1000 beads of 10 mm at 100 m/s in a closed box of thin triangles, at the automatic step (0.1 d in a step) and at
    // ten and a hundred times that: the charge piles up on faces and in corners, and each bead is hit by others while
    // it touches a wall. What looks along velocities alone misses what is struck within the step, and what cuts off
    // speeds loses momentum. A bead has escaped when its centre is behind a wall.
    HardCase hard("32 a shotgun in a closed box");
    for (const std::string restitution : {"0", "0.9", "1"}) {
        double deepest = -infinity, most_energy = 0.0;
        int most_sub_steps = 1;
        bool whole = true;
        for (const std::string step : {"auto", "1e-4", "1e-3"}) {
            Simulation simulation =
                open_scene("shotgun", {"contact.steel-steel.restitution=" + restitution, "time.step=" + step});
            const double first_energy = kinetic_energy(simulation.state);
            while (!has_reached(simulation, simulation.duration)) {
                const auto report = talus::advance(simulation);
                whole = whole && report.bodies.incidents.empty();
                deepest = std::max(deepest, deepest_outside(simulation.state) / simulation.model.mean_diameter);
                most_energy = std::max(most_energy, report.bodies.kinetic_energy / first_energy);
                most_sub_steps = std::max(most_sub_steps, report.sub_steps);
            }
            whole = whole && simulation.state.count() == 1000;
        }
        const std::string which = ", e = " + restitution;
        hard.below("deepest centre behind a wall" + which + " [d]", deepest, 0.0);
        hard.holds("1000 beads and no incident" + which, whole);
        hard.below("most kinetic energy" + which + " [of the first]", most_energy, 1.01);
        hard.tell("most sub-steps of a step" + which, most_sub_steps);
    }
}
