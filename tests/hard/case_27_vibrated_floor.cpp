// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double h = automatic_step();
constexpr double pi = std::numbers::pi;
constexpr double frequency = 10.0; ///< a step is 0.9 degrees of a period
constexpr double omega = 2 * pi * frequency;

struct Ride {
    int free_steps = 0;      ///< in which the floor was not loaded
    double left_at = -1.0;   ///< phase at which the floor's load was first gone [degree]
    double least_load = 1e9; ///< of the floor before that [weight]
};

/// A column of spheres on a floor that has been shaken with A ω² = gamma g for a while; they go with it at first.
Ride ride(int spheres, double gamma, Stabilisation law, double periods)
{
    World world = production_world({.friction = 0.5}, law);
    const double amplitude = gamma * standard_gravity / (omega * omega);
    world.add_wall(Plane{}, {Shaking{{}, amplitude * Vec3::UnitZ(), frequency}});
    world.state.steps = static_cast<std::int64_t>(std::round(1.0 / (frequency * h)));
    const double begin = world.state.time = static_cast<double>(world.state.steps) * h;
    for (int k = 0; k < spheres; ++k)
        world.add_sphere(Vec3(0, 0, (k + 0.5) * d + amplitude * std::sin(omega * begin)),
            omega * amplitude * std::cos(omega * begin) * Vec3::UnitZ());
    const double weight = spheres * world.mass() * standard_gravity;
    Ride result;
    while (world.state.time < begin + periods / frequency) {
        const double phase = std::remainder(360.0 * frequency * world.state.time, 360.0);
        world.step();
        const double load = world.report.outcome.from_walls.impulse.z() / h / weight;
        if (load > 0.0) {
            if (result.left_at < 0.0) result.least_load = std::min(result.least_load, load);
            continue;
        }
        ++result.free_steps;
        if (result.left_at < 0.0) result.left_at = phase;
    }
    return result;
}

} // namespace

TEST_CASE("27 vibrated floor", "[hard][quick]")
{
    // The floor's acceleration is −Γ g sin φ: the load is 1 − Γ sin φ weights, least 0.1 at Γ = 0.9, and gone at
    // φ = asin(1/Γ) at Γ = 1.1. A contact that is cold or soft for a step chatters; one that is held by its warm start
    // leaves late.
    HardCase hard("27 vibrated floor");
    const double expected = std::asin(1.0 / 1.1) * 180.0 / pi;
    for (const auto law : {Stabilisation::matched, Stabilisation::projected})
        for (const int spheres : {1, 5}) {
            const std::string name = name_of(law) + (spheres == 1 ? ", a sphere: " : ", a column of five: ");
            const Ride held = ride(spheres, 0.9, law, 20), thrown = ride(spheres, 1.1, law, 1);
            hard.below(name + "steps without load at 0.9 g in 20 periods", held.free_steps, 0.5);
            hard.between(name + "least load there [weight]", held.least_load, 0.09, 0.11);
            hard.between(
                name + "phase at which it leaves at 1.1 g [degree]", thrown.left_at, expected - 2, expected + 2);
        }
}
