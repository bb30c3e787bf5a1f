// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy_books.hpp"
#include "hard_case.hpp"

#include "tests/support/median.hpp"
#include "tests/support/world.hpp"
#include "tests/validation/run_scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double r = standard_radius;
constexpr double slope = 0.5; // rad

/// A sphere on an incline that falls along x.
World on_incline(double friction)
{
    World world = production_world({.friction = friction});
    world.model.gravity = standard_gravity * Vec3(std::sin(slope), 0, -std::cos(slope));
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    return world;
}

/// 64 spheres that spin and fly about, dropped into an open box.
/// @param phase makes boxes that differ in the spheres' velocities and spins
World stirred_box(double friction, double phase)
{
    World world = production_world({.friction = friction});
    constexpr double edge = 4 * 2.4 * r;
    world.add_wall(box_panels({Vec3::Zero(), Vec3(edge, edge, 0.5)}, {"z+"}));
    for (int k = 0; k < 64; ++k)
        world.add_sphere(2.4 * r * Vec3(k % 4 + 0.5, k / 4 % 4 + 0.5, k / 16 + 1.0),
            Vec3(0.3 * std::sin(k + phase), 0.3 * std::cos(2 * k + phase), -0.2),
            100 * Vec3(std::sin(3 * k + phase), std::cos(k + phase), std::sin(7 * k + phase)),
            r * (0.9 + 0.1 * std::cos(5 * k)));
    return world;
}

/// What a run did to its energy, kinetic, potential and stored [that at the start].
struct Gain {
    double above_start = 0.0; ///< the most
    double rises = 0.0;       ///< in single steps, all together
};

Gain gain_of_energy(World world, int steps)
{
    const double start = energy_of_flight(world.state, world.model);
    EnergyBooks books(start);
    Gain gain;
    for (int k = 0; k < steps; ++k) {
        world.step();
        gain.rises += books.enter(world.report, energy_of_flight(world.state, world.model)) / start;
        gain.above_start = std::max(gain.above_start, books.complete() / start - 1.0);
    }
    return gain;
}

/// Rises are rare and of all sizes, 1e-5 to 3e-3 in a box, so many boxes are asked.
void judge_stirred_boxes(HardCase& hard, const std::string& which, double friction)
{
    constexpr int boxes = 96;
    double above_start = 0.0;
    std::vector<double> rises;
    for (int box = 0; box < boxes; ++box) {
        const Gain gain = gain_of_energy(stirred_box(friction, 0.1 * box), 6000);
        above_start = std::max(above_start, gain.above_start);
        rises.push_back(gain.rises);
    }
    hard.below(which + "energy of a stirred box above that at the start, worst of 96 [of it]", above_start, 1e-6);
    hard.below(which + "its rises in single steps, all together, median of 96 [start]", median(rises), 1e-4);
}

} // namespace

TEST_CASE("10 no friction, and friction of 10 and 1e6", "[hard]")
{
    // Without friction nothing tangential is there at all: the bits of what slides along and of what spins stay. With
    // very much, the disk never cuts: a sphere rolls down whatever the slope, 5/7 g sin theta, and impulses, each of
    // them far from the cone's edge, must not feed each other.
    HardCase hard("10 no friction, and friction of 10 and 1e6");
    World smooth = on_incline(0.0);
    const Vec3 spin(30, -70, 11);
    smooth.add_sphere(r * Vec3::UnitZ(), Vec3(0, 0.7, 0), spin);
    const int steps = 20000;
    smooth.step(steps);
    const double time = smooth.state.time;
    hard.below("mu = 0: acceleration down the incline, error of g sin theta",
        std::abs(smooth.velocity().x() / (standard_gravity * std::sin(slope) * time) - 1.0), 1e-11); // 2e4 roundings
    hard.holds("mu = 0: speed across the incline is the same to the bit", smooth.velocity().y() == 0.7);
    hard.holds("mu = 0: spin is the same to the bit", smooth.angular_velocity() == spin);
    judge_stirred_boxes(hard, "mu = 0: ", 0.0);

    World block = on_incline(0.2);
    block.model.physics.spin = false;
    block.add_sphere((1 - 1e-6) * r * Vec3::UnitZ());
    block.step(1000);
    const double speed = block.velocity().x(), since = block.state.time;
    block.step(steps);
    hard.below("mu = 0.2, a block: acceleration, error of g (sin theta - mu cos theta)",
        std::abs((block.velocity().x() - speed) / (block.state.time - since) /
                     (standard_gravity * (std::sin(slope) - 0.2 * std::cos(slope))) -
                 1.0),
        1e-9);

    for (const double friction : {10.0, 1e6}) {
        const std::string which = friction > 100 ? "mu = 1e6: " : "mu = 10: ";
        World rolling = on_incline(friction);
        rolling.add_sphere((1 - 1e-6) * r * Vec3::UnitZ());
        rolling.step(steps);
        hard.below(which + "acceleration down the incline, error of 5/7 g sin theta",
            std::abs(rolling.velocity().x() / (5.0 / 7.0 * standard_gravity * std::sin(slope) * time) - 1.0), 1e-9);
        hard.below(which + "slip [speed]", slip(rolling).norm() / rolling.velocity().norm(), 1e-12);
        judge_stirred_boxes(hard, which, friction);
    }
}

TEST_CASE("10 piles with friction of 10 and 1e6", "[hard]")
{
    // Spheres without rolling resistance give way by rolling, so their angle of repose does not rise with friction any
    // more: 19 to 26 degrees, as with 0.5. A cone that dilates, or friction that acts as an attraction, stands steeper.
    HardCase hard("10 piles with friction of 10 and 1e6");
    for (const char* friction : {"10", "1e6"}) {
        auto simulation = open_scene("rough_pile", {std::string("contact.0.friction=") + friction});
        run_until(simulation, 5.0);
        const auto angle = result(simulation, "heap", "angle");
        hard.between(std::string("mu = ") + friction + ": angle of repose [degrees]", angle.value, 19, 26);
    }
}
