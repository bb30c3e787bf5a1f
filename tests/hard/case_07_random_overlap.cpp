// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "core/base/region.hpp"
#include "core/step/relaxation.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 0.01; // m
constexpr int count = 10000;

/// A closed box with spheres as a file might list them: at random places in its lowest part, which they fill to this
/// fraction, whatever they overlap. @param height of the box / that of the part
Simulation crowded_box(double solid_fraction, double height)
{
    const double edge = std::cbrt(count * std::numbers::pi / 6 * d * d * d / solid_fraction);
    scene::Scene scene;
    scene.materials = {{"grain", 2500.0}};
    scene.contact = {{{"grain", "grain"}, 0.5}};
    scene::WallTable box;
    box.name = "box";
    box.shape = "box";
    box.material = "grain";
    box.max = Vec3(edge, edge, height * edge);
    scene.wall = {box};
    scene::FillTable fill;
    fill.arrangement = "file";
    fill.material = "grain";
    Random random(7);
    for (int k = 0; k < count; ++k) {
        Vec3 place;
        for (int axis = 0; axis < 3; ++axis) place[axis] = d / 2 + (edge - d) * uniform(random);
        fill.spheres.positions.push_back(place);
        fill.spheres.radii.push_back(d / 2);
    }
    scene.fill = {fill};
    return build_scene(scene).simulation;
}

/// A run of it.
struct Settling {
    double fastest = 0.0;      ///< [m/s]
    double finite_limit = 0.0; ///< sqrt(2 g H) + 1 m/s
    std::size_t escaped = 0;   ///< or not a number, or blown up, in any step; centres out of the box at the end
    OverlapCheck left;
};

Settling run(Simulation& simulation, double duration)
{
    Settling result;
    const Box box = bounds(simulation.model.walls[0].shape);
    result.finite_limit = std::sqrt(2 * standard_gravity * box.extent().z()) + 1.0;
    while (!has_reached(simulation, duration)) {
        const auto report = advance(simulation);
        result.fastest = std::max(result.fastest, report.bodies.fastest_speed);
        result.escaped += report.bodies.incidents.size();
        if (result.escaped > 0) break;
    }
    for (const Vec3& x : simulation.state.position) result.escaped += !box.contains(x);
    result.left = check_overlaps(simulation);
    return result;
}

std::size_t outside(const Simulation& simulation)
{
    const Box box = bounds(simulation.model.walls[0].shape);
    return static_cast<std::size_t>(
        std::ranges::count_if(simulation.state.position, [&](const Vec3& x) { return !box.contains(x); }));
}

void judge(HardCase& hard, const std::string& which, const Settling& result, double largest_overlap)
{
    hard.between(which + ": spheres out of the box or incidents", static_cast<double>(result.escaped), 0, 0);
    hard.below(which + ": fastest speed [sqrt(2 g H) + 1 m/s]", result.fastest / result.finite_limit, 1.0);
    hard.tell(which + ": fastest speed [push-out speed]", result.fastest / automatic_push_out_speed());
    hard.below(which + ": worst overlap at the end [d]", result.left.worst / d, largest_overlap);
}

/// A run after --relax, which is what the program advises.
void run_relaxed(HardCase& hard, double solid_fraction, double height, double largest_overlap)
{
    auto simulation = crowded_box(solid_fraction, height);
    const int steps = relax_overlaps(simulation.state, simulation.model, check_overlaps(simulation).worst);
    hard.tell("relaxed: steps", steps);
    hard.tell("relaxed: worst overlap before the run [d]", check_overlaps(simulation).worst / d);
    hard.between("relaxed: spheres out of the box", static_cast<double>(outside(simulation)), 0, 0);
    judge(hard, "relaxed, then run", run(simulation, 0.2), largest_overlap);
}

void run_as_it_is(HardCase& hard, double solid_fraction, double height, double largest_overlap)
{
    auto simulation = crowded_box(solid_fraction, height);
    hard.above("worst overlap at the start [d]", check_overlaps(simulation).worst / d, 0.9);
    judge(hard, "as it is", run(simulation, 0.8), largest_overlap);
}

} // namespace

TEST_CASE("7 10 000 spheres deep in each other, with room above", "[hard]")
{
    // Random places: each overlaps six others, the worst wholly. They fill 0.8 of the lower half of a closed box.
    HardCase hard("7 10 000 spheres deep in each other, with room above");
    run_as_it_is(hard, 0.8, 2.0, 0.01);
    run_relaxed(hard, 0.8, 2.0, 0.01);
}

TEST_CASE("7 10 000 spheres deep in each other, fairly dense", "[hard]")
{
    // All of a closed box, with 0.55 of it to fill: below the 0.64 of a random packing, so there is room for all.
    HardCase hard("7 10 000 spheres deep in each other, fairly dense");
    run_as_it_is(hard, 0.55, 1.0, 0.01);
    run_relaxed(hard, 0.55, 1.0, 0.01);
}

TEST_CASE("7 10 000 spheres deep in each other, too many", "[hard]")
{
    // 0.8 of a closed box cannot be filled without overlap: the densest lattice has 0.74, a random packing 0.64, which
    // leaves (0.8/0.64)^(1/3) - 1 = 8 % d on average. What can be asked of them is that they stay inside, and, moved
    // apart first, as a run advises, slow and finite. As it is, each contact pushes with 0.03 m/s, and a pack that has
    // nowhere to go adds these up to a hundred and fifty times that: it boils. It is the speed with which one contact
    // opens, so the sum may be more in the other cases too, beside the spheres' free fall.
    HardCase hard("7 10 000 spheres deep in each other, too many");
    auto simulation = crowded_box(0.8, 1.0);
    const auto as_it_is = run(simulation, 0.8);
    hard.between("as it is: spheres out of the box or incidents", static_cast<double>(as_it_is.escaped), 0, 0);
    hard.tell("as it is: fastest speed [sqrt(2 g H) + 1 m/s]", as_it_is.fastest / as_it_is.finite_limit);
    hard.tell("as it is: worst overlap at the end [d]", as_it_is.left.worst / d);
    run_relaxed(hard, 0.8, 1.0, 0.4);
}
