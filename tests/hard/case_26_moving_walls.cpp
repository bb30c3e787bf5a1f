// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double h = automatic_step();
constexpr double pi = std::numbers::pi;

/// Of a drum, less than half full, that turns about y; periodic along y.
World drum(Stabilisation law)
{
    World world = production_world({.friction = 0.5, .restitution = 0.3}, law);
    world.model.periodicity = {Vec3::Zero(), Vec3(infinity, 4 * d, infinity)};
    world.add_wall(
        Cylinder{Vec3::Zero(), Vec3::UnitY(), 5 * d, 4 * d}, {Turning{{}, Vec3::Zero(), Vec3::UnitY(), 3.0}});
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 4; ++k)
                world.add_sphere(d * Vec3(1.05 * (i - 2.5), 0.6 + 1.3 * j + 0.1 * (k % 2), 1.05 * k - 2.5),
                    Vec3::Zero(), Vec3::Zero(), standard_radius * (1 - 0.02 * ((i + j + k) % 5)));
    return world;
}

/// Of a box that is shaken up and down, and less to the side, with three times gravity.
World shaken_box(Stabilisation law)
{
    World world = production_world({.friction = 0.5, .restitution = 0.3}, law);
    constexpr double frequency = 25.0;
    const double amplitude = 3.0 * standard_gravity / std::pow(2 * pi * frequency, 2);
    world.add_wall(box_panels({Vec3::Zero(), 4.2 * d * Vec3(1, 1, 10)}, {}),
        {Shaking{{}, amplitude * Vec3(0.2, 0, 1), frequency}});
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k)
                world.add_sphere(1.04 * d * Vec3(0.51 + i, 0.51 + j, 0.6 + k), Vec3::Zero(), Vec3::Zero(),
                    standard_radius * (1 - 0.02 * ((i + j + k) % 5)));
    return world;
}

struct Balance {
    double wall_work = 0.0, dissipated = 0.0; ///< [J]
    double worst_leak = 0.0;                  ///< of a step's balance [J]
    double least = 0.0;                       ///< dissipation of a step [J]
};

/// The dissipation of the contacts of the step just made, −Σ λ·(u⁽⁰⁾ + u⁽¹⁾)/2, from their impulses and the velocities
/// before and after it.
double contact_dissipation(const World& world, const State& before)
{
    const auto& walls = world.model.walls;
    double sum = 0.0;
    for (const auto& force : world.contact_forces()) {
        const auto i = world.index_of(force.a);
        const auto mean = [&](std::size_t k, const Vec3& arm) -> Vec3 {
            const Body& now = world.state.body(k);
            const Vec3 velocity = 0.5 * (before.body(k).velocity + now.velocity);
            const Vec3 rim = 0.5 * (before.body(k).rim_velocity + now.rim_velocity);
            return velocity + rim.cross(arm) / now.spin_radius;
        };
        const double radius = world.radius(force.a);
        Vec3 u;
        if (force.with_wall) {
            const Vec3 x = before.position[i] - radius * force.normal;
            const auto& motion = walls[static_cast<std::size_t>(force.b)].motion;
            const Twist twist = twist_between(pose_at(motion, before.time), pose_at(motion, before.time + h), h);
            u = mean(i, -radius * force.normal) - twist.at(x);
        } else {
            const double other = world.radius(force.b), scale = force.arm_scale;
            u = mean(i, -scale * radius * force.normal) - mean(world.index_of(force.b), scale * other * force.normal);
        }
        sum -= h * (force.normal_force * force.normal + force.tangent_force).dot(u);
    }
    return sum;
}

Balance run(World world, double settle, double duration)
{
    Balance balance;
    while (world.state.time < settle + duration) {
        const State before = world.state;
        world.step();
        if (before.steps % 1000 == 0 || world.state.time < settle) continue; // spheres may have been renumbered
        double gravity_work = 0.0;
        for (std::size_t i = 0; i < before.count(); ++i)
            gravity_work += world.state.mass(i) * h *
                            world.model.gravity.dot(0.5 * (before.body(i).velocity + world.state.body(i).velocity));
        const double dissipated = contact_dissipation(world, before);
        const double work = world.report.outcome.wall_work;
        balance.wall_work += work;
        balance.dissipated += dissipated;
        balance.least = std::min(balance.least, dissipated);
        balance.worst_leak = std::max(balance.worst_leak,
            std::abs(gravity_work + work - dissipated - (kinetic_energy(world.state) - kinetic_energy(before))));
    }
    return balance;
}

} // namespace

TEST_CASE("26 shaken box and turning drum", "[hard]")
{
    // What walls put in is what contacts take out: both are summed from the impulses, independently, over many periods
    // or turns. Walls whose velocity and torque are taken at different points, or impulses that are kept in another
    // frame than they acted in, do not balance.
    HardCase hard("26 shaken box and turning drum");
    for (const auto law : {Stabilisation::matched, Stabilisation::projected}) {
        const std::string name = name_of(law) + ", ";
        for (const bool turning : {true, false}) {
            const Balance balance = turning ? run(drum(law), 1.0, 20.0) : run(shaken_box(law), 0.4, 8.0);
            const std::string scene = name + (turning ? "drum: " : "box: ");
            hard.above(scene + "work of the wall [J]", balance.wall_work, 1e-3);
            hard.between(scene + "dissipation [work of the wall]", balance.dissipated / balance.wall_work, 0.98, 1.02);
            hard.below(
                scene + "worst leak of a step [work of the wall]", balance.worst_leak / balance.wall_work, 1e-12);
            hard.tell(scene + "least dissipation of a step [work of the wall]", balance.least / balance.wall_work);
        }
    }
}
