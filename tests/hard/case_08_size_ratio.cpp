// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"
#include "tests/validation/run_scene.hpp"

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

/// A sphere on the floor under one of 20 times its size: normals at acos((20 − 1)/(20 + 1)), a wedge of half of it.
const double tan_wedge = std::tan(0.5 * std::acos(19.0 / 21.0));

/// A run until its spheres are at rest, and its last fifth.
struct Rest {
    double fastest = 0.0;       ///< in the whole run [fall / tan psi + 1 m/s]
    double force_error = 0.0;   ///< mean force on the walls, of the weight
    double force_spread = 0.0;  ///< rms of the force in a step about the weight, of it
    double worst_overlap = 0.0; ///< of the last fifth [smallest d]
    double deepest = 0.0;       ///< overlap of the whole run [smallest d]
    std::size_t outside = 0;    ///< centres out of the box, or incidents
    double candidates = 0.0;    ///< listed pairs per contact
    double searched = 0.0;      ///< spheres searched anew per step, of all
    double sweeps = 0.0;
};

Rest settle(Simulation& simulation)
{
    const auto& model = simulation.model;
    const auto& state = simulation.state;
    const Box box = bounds(model.walls[0].shape);
    const double limit = std::sqrt(2 * standard_gravity * box.extent().z()) / tan_wedge + 1.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) weight += state.mass(i) * standard_gravity;
    Rest rest;
    double steps = 0.0, all_steps = 0.0, contacts = 0.0, candidates = 0.0;
    while (!has_reached(simulation, simulation.duration)) {
        const auto report = advance(simulation);
        rest.outside += report.bodies.incidents.size();
        rest.fastest = std::max(rest.fastest, report.bodies.fastest_speed / limit);
        rest.deepest = std::max(rest.deepest, report.contacts.worst_overlap / model.min_diameter);
        rest.searched += static_cast<double>(report.search.searched) / static_cast<double>(state.count());
        ++all_steps;
        if (state.time < 0.8 * simulation.duration) continue;
        const double force = report.outcome.from_walls.impulse.z() / model.time_step / weight - 1.0;
        rest.force_error += force;
        rest.force_spread += force * force;
        rest.worst_overlap = std::max(rest.worst_overlap, report.contacts.worst_overlap / model.min_diameter);
        rest.sweeps += report.solve.sweeps;
        contacts += static_cast<double>(report.contacts.count);
        candidates += static_cast<double>(report.search.candidates);
        ++steps;
    }
    rest.force_error = std::abs(rest.force_error / steps);
    rest.force_spread = std::sqrt(rest.force_spread / steps);
    rest.candidates = candidates / contacts;
    rest.searched /= all_steps;
    rest.sweeps /= steps;
    for (const Vec3& x : state.position) rest.outside += !box.contains(x);
    return rest;
}

void judge(HardCase& hard, const Rest& rest)
{
    hard.between("spheres out of the box or incidents", static_cast<double>(rest.outside), 0, 0);
    hard.below("fastest speed [sqrt(2 g H) / tan psi + 1 m/s]", rest.fastest, 1.0);
    hard.below("mean force on the box, error", rest.force_error, 0.01);
    hard.below("worst overlap at rest [small d]", rest.worst_overlap, 0.5);
    hard.tell("worst overlap at all [small d]", rest.deepest);
    hard.tell("force on the box in a step, rms error", rest.force_spread);
    hard.tell("sweeps at rest", rest.sweeps);
}

} // namespace

// Mass ratio 1:8000. A grid of cells as large as the largest sphere would list thousands of small ones for each other,
// a tree or sorted boxes must not; a heavy sphere on light ones converges in M/m sweeps instead of one; and a small one
// between a large one and a wall is what is pressed through it. It may well be faster than anything that falls: the
// wedge between a large sphere that comes down with V and the floor squeezes it out with V/tan psi, 4.5 V. (Measured
// with one large sphere at about 1 m/s: 5 m/s with `projected`, with 20 sweeps at least and with 0.4 of the step, 8.7
// m/s as it is, for contacts are as soft as suits the smaller mass, and what they store comes back.) Under three layers
// of large ones a contact bears some thousand small weights and is 0.1 d deep, which is its load over the stiffness
// that two sweeps can carry; through it would be 0.5 d.

TEST_CASE("8 size ratio 1:20, one large among 8000 small", "[hard]")
{
    HardCase hard("8 size ratio 1:20, one large among 8000 small");
    auto small = open_scene("two_sizes", {"fill.0.count=0"});
    const Rest without = settle(small);
    auto all = open_scene("two_sizes");
    const Rest rest = settle(all);
    judge(hard, rest);
    hard.below("listed pairs per contact [without it]", rest.candidates / without.candidates, 3.0);
    hard.below("spheres searched anew in a step [without it]", rest.searched / without.searched, 3.0);
}

TEST_CASE("8 size ratio 1:20, twenty large on 20 000 small", "[hard]")
{
    HardCase hard("8 size ratio 1:20, twenty large on 20 000 small");
    auto simulation = open_scene("large_on_small");
    judge(hard, settle(simulation));
}
