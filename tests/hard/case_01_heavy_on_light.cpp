// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double time_step = automatic_step();

World rigid_world(bool scaled)
{
    ContactLaw law;
    law.friction = 0.5;
    World world = make_world(law, production_settings(Stabilisation::projected), time_step);
    world.model.solver.pressure_scaling = scaled;
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    return world;
}

/// A sphere, and on it one of the same size that is heavier.
World sphere_on_sphere(double ratio, bool scaled)
{
    World world = rigid_world(scaled);
    world.add_sphere(Vec3(0, 0, 0.5 * d));
    world.add_sphere(Vec3(0, 0, 1.5 * d), Vec3::Zero(), Vec3::Zero(), standard_radius, ratio * standard_density);
    return world;
}

/// Nine spheres in a square, and on them a plate that is heavier than each.
World plate_on_nine(double ratio, bool scaled)
{
    World world = rigid_world(scaled);
    for (int k = 0; k < 9; ++k) world.add_sphere(d * Vec3(1.5 * (k % 3 - 1), 1.5 * (k / 3 - 1), 0.5));
    const Vec3 low = d * Vec3(-3, -3, 1), high = d * Vec3(3, 3, 2);
    world.add_piston(box_panels({low, high}, {}), ratio * world.mass(), -Vec3::UnitZ());
    return world;
}

struct Outcome {
    double overlap = 0.0;     ///< the worst of the last second [d]
    double floor_error = 0.0; ///< the worst of the last second, of the weight
    double way = 0.0;         ///< of any light sphere from where it began [d]
    double sweeps = 0.0;      ///< after which the floor's force stays within 5 %
};

/// @param light how many light spheres there are; they come first
Outcome watch(World world, int light, double weight)
{
    const World begin = world;
    constexpr double duration = 5.0, watched = 1.0;
    const int steps = static_cast<int>(duration / time_step);
    Outcome out;
    double sweeps = 0.0;
    for (int k = 1; k <= steps; ++k) {
        world.step();
        const double error = std::abs(world.report.outcome.from_walls.impulse.z() / time_step - weight) / weight;
        sweeps += world.report.solve.sweeps;
        if (error > 0.05) out.sweeps = sweeps;
        for (int id = 0; id < light; ++id)
            out.way = std::max(out.way, (world.position(id) - begin.position(id)).norm() / d);
        if (k * time_step < duration - watched) continue;
        out.overlap = std::max(out.overlap, world.report.contacts.worst_overlap / d);
        out.floor_error = std::max(out.floor_error, error);
    }
    return out;
}

void ask(HardCase& hard, const std::string& what, const Outcome& scaled, const Outcome& plain)
{
    hard.below(what + ": overlap after 5 s [d]", scaled.overlap, 0.01);
    hard.below(what + ": error of the floor's force", scaled.floor_error, 0.01);
    hard.below(what + ": way of a light one [d]", scaled.way, 1e-3);
    hard.tell(what + ": sweeps until the floor's force stays within 5 %", scaled.sweeps);
    hard.tell(what + ", without scaling: overlap [d]", plain.overlap);
    hard.tell(what + ", without scaling: error of the floor's force", plain.floor_error);
    hard.tell(what + ", without scaling: sweeps until the floor's force stays within 5 %", plain.sweeps);
}

} // namespace

// The light one lies between two heavy things, of which a sweep corrects one at a time: plain sweeps need M/m ln(1/ε)
// of them. Law `projected` with pressure scaling, production sweeps (3 to 100, tolerance 1e-2).

TEST_CASE("1 a sphere on a lighter one", "[hard]")
{
    HardCase hard("1 a sphere on a lighter one");
    for (const double ratio : {10.0, 100.0, 1000.0}) {
        const double weight =
            (1.0 + ratio) * rigid_world(false).model.gravity.norm() * sphere_on_sphere(1, false).mass();
        ask(hard, "1:" + std::to_string(static_cast<int>(ratio)), watch(sphere_on_sphere(ratio, true), 1, weight),
            watch(sphere_on_sphere(ratio, false), 1, weight));
    }
}

TEST_CASE("1 a heavy plate on nine spheres", "[hard]")
{
    HardCase hard("1 a heavy plate on nine spheres");
    for (const double ratio : {10.0, 100.0, 1000.0, 10000.0}) {
        const World world = plate_on_nine(ratio, true);
        const double weight = (9.0 + ratio) * world.mass() * standard_gravity;
        ask(hard, "1:" + std::to_string(static_cast<int>(ratio)), watch(world, 9, weight),
            watch(plate_on_nine(ratio, false), 9, weight));
    }
}
