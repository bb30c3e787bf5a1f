// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "flat_mesh.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double spin = 1e5; // rad/s
constexpr double rim_speed = spin * standard_radius;
constexpr double friction = 0.5;

/// A sphere with this spin at rest on a floor.
World spinning_sphere(const Shape& floor, const Vec3& angular_velocity, double restitution = 0.0)
{
    World world = production_world({.friction = friction, .restitution = restitution});
    world.add_wall(floor);
    world.add_sphere(standard_radius * Vec3::UnitZ(), Vec3::Zero(), angular_velocity);
    return world;
}

double energy(const World& world)
{
    return kinetic_energy(world.state) + potential_energy(world.state, world.model.gravity);
}

/// What a sphere with top spin does until it rolls and a second longer.
struct TakeOff {
    double until_rolling = 0.0; ///< [s]
    double height = 0.0;        ///< largest change of it [d]
    double rise = 0.0;          ///< largest rise of the energy in a step, of the energy at the start
    Vec3 velocity, rim_velocity;
};

TakeOff take_off(World world)
{
    TakeOff result;
    world.step();
    const double start = energy(world);
    double last = start;
    const double second = 1.0 / world.model.time_step;
    for (int left = static_cast<int>(40.0 * second); left > 0; --left) {
        world.step();
        result.height =
            std::max(result.height, std::abs(world.position().z() - standard_radius) / (2 * standard_radius));
        result.rise = std::max(result.rise, (energy(world) - last) / start);
        last = energy(world);
        if (result.until_rolling > 0.0 || slip(world).norm() > 1e-9 * rim_speed) continue;
        result.until_rolling = world.state.time;
        left = static_cast<int>(second);
    }
    result.velocity = world.velocity();
    result.rim_velocity = world.state.body(0).rim_velocity;
    return result;
}

} // namespace

TEST_CASE("17 a sphere spins with 100 000 rad per s", "[hard]")
{
    // The rim moves with 500 m/s, which is 13 diameters in a step; the sphere takes off with 2/7 of that, 143 m/s,
    // after 29 s. A step sized by gravity alone must do, for the sphere itself stays where it is at first. Orientations
    // are not kept, so a free spin is for ever; what must not happen is that friction, whose slip is ten thousand times
    // what gravity makes in a step, turns the spin round, lifts the sphere or feeds it.
    HardCase hard("17 a sphere spins with 100 000 rad per s");
    const double expected = 2.0 / 7.0 * rim_speed, duration = 2.0 * rim_speed / (7.0 * friction * standard_gravity);
    for (const double restitution : {0.0, 0.9}) {
        const auto result = take_off(spinning_sphere(Plane{}, spin * Vec3::UnitY(), restitution));
        const std::string which = restitution > 0 ? "restitution 0.9: " : "";
        hard.below(which + "time until it rolls, error", std::abs(result.until_rolling / duration - 1.0), 1e-4);
        hard.below(which + "speed at the end, error of 2/7 r omega",
            (result.velocity - expected * Vec3::UnitX()).norm() / expected, 1e-10);
        hard.below(which + "spin at the end, error", (result.rim_velocity - expected * Vec3::UnitY()).norm() / expected,
            1e-10);
        hard.below(which + "height [d]", result.height, 1e-4);
        hard.below(which + "rise of the energy in a step [energy at the start]", result.rise, 1e-12);
    }
    // About its normal a contact has no lever: the spin lasts.
    World top = spinning_sphere(Plane{}, spin * Vec3::UnitZ());
    top.step(100000);
    hard.below(
        "about the normal: spin after 1e5 steps, error", std::abs(top.angular_velocity().z() / spin - 1.0), 1e-12);
    hard.below("about the normal: speed after 1e5 steps [m/s]", top.velocity().norm(), 1e-9);
    // In between: the spin across the normal goes into the take-off, that about it stays.
    World between = spinning_sphere(Plane{}, spin * Vec3(0, 0.6, 0.8));
    between.step(120000);
    hard.below("at an angle: speed at the end, error",
        (between.velocity() - 0.6 * expected * Vec3::UnitX()).norm() / expected, 1e-10);
    hard.below("at an angle: spin about the normal at the end, error",
        std::abs(between.angular_velocity().z() / (0.8 * spin) - 1.0), 1e-12);
}

TEST_CASE("17 spheres with 100 000 rad per s meet", "[hard][quick]")
{
    // Glancing and head-on; momentum and angular momentum are kept whatever the slip.
    HardCase hard("17 spheres with 100 000 rad per s meet");
    double linear = 0.0, angular = 0.0, gain = 0.0;
    for (const double restitution : {0.0, 0.5, 1.0})
        for (const double offset : {0.0, 0.3, 0.9})
            for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(0.6, 0, 0.8), Vec3(-0.48, 0.6, 0.64)}) {
                World world = production_world({.friction = friction, .restitution = restitution});
                world.model.gravity.setZero();
                world.add_sphere(Vec3(-1.2 * standard_radius, 0, 0), Vec3(1, 0, 0), spin * axis);
                world.add_sphere(
                    Vec3(1.2 * standard_radius, offset * 2 * standard_radius, 0), Vec3(-1, 0, 0), -0.7 * spin * axis);
                const Vec3 momentum = linear_momentum(world.state), turn = angular_momentum(world.state);
                const double start = kinetic_energy(world.state);
                world.step(200);
                linear = std::max(linear, (linear_momentum(world.state) - momentum).norm() / world.mass());
                // of 2/5 m r² ω
                angular = std::max(angular,
                    (angular_momentum(world.state) - turn).norm() / (0.4 * world.mass() * standard_radius * rim_speed));
                gain = std::max(gain, kinetic_energy(world.state) / start - 1.0);
            }
    hard.below("momentum, error [m x 1 m/s]", linear, 1e-12);
    hard.below("angular momentum, error [that of one]", angular, 1e-12);
    hard.below("gain of energy [energy at the start]", gain, 1e-12);
}
