// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double gravity = 9.81, d = 0.01, ratio = 50.0, edge = 0.33; // m/s², m, edge of the box [m]
/// A grain on the floor under the ball: normals at acos((50 − 1)/(50 + 1)), a wedge of half of it.
const double tan_wedge = std::tan(0.5 * std::acos((ratio - 1) / (ratio + 1)));

struct Load {
    double fastest = 0.0;              ///< of any sphere in any step [m/s]
    double deepest = 0.0, worst = 0.0; ///< overlap of the whole run, and of its last fifth [d]
    double through = 0.0;              ///< most grains whose centre is below the floor
    double outside = 0.0;              ///< spheres that are not in the box at the end
    double incidents = 0.0;            ///< escapes and presses
    double force_error = 0.0;          ///< of the mean force on the box in the last fifth [weight]
    double force_spread = 0.0;         ///< rms of that of a step about the weight [weight]
    double kinetic = 0.0;              ///< energy, mean of the last fifth [weight × d]
    double bottom = infinity;          ///< lowest point of the ball, lowest of all steps [d]
    double sweeps = 0.0;               ///< of the last fifth
};

Load carry(const std::string& law, double bottom)
{
    auto simulation = open_scene("large_ball",
        {"solver.stabilisation=" + law, fmt::format("fill.1.position=[0.165, 0.165, {}]", bottom + 0.25)});
    const auto& model = simulation.model;
    const auto& state = simulation.state;
    const std::size_t count = state.count();
    const Box base{Vec3(0, 0, 0), Vec3(edge, edge, 0)}, box{Vec3(0, 0, 0), Vec3(edge, edge, 0.4)};
    double weight = 0.0, steps = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) weight += state.mass(i) * gravity;
    Load found;
    const auto watch = [&](const StepReport& report) {
        found.incidents += static_cast<double>(report.bodies.incidents.size());
        found.fastest = std::max(found.fastest, report.bodies.fastest_speed);
        found.deepest = std::max(found.deepest, report.contacts.worst_overlap / d);
        double through = 0.0;
        for (std::size_t i = 0; i < state.count(); ++i) {
            const Vec3& x = state.position[i];
            through += !(x.z() > 0.0) && base.contains(Vec3(x.x(), x.y(), 0.0));
            if (state.radius[i] > d) found.bottom = std::min(found.bottom, (x.z() - state.radius[i]) / d);
        }
        found.through = std::max(found.through, through);
        if (state.time < 0.8 * simulation.duration) return;
        const double force = report.outcome.from_walls.impulse.z() / model.time_step / weight - 1.0;
        found.force_error += force;
        found.force_spread += force * force;
        found.worst = std::max(found.worst, report.contacts.worst_overlap / d);
        found.kinetic += report.bodies.kinetic_energy / (weight * d);
        found.sweeps += report.solve.sweeps;
        ++steps;
    };
    talus::run_until(simulation, simulation.duration, {.after_step = watch});
    found.force_error = std::abs(found.force_error / steps);
    found.force_spread = std::sqrt(found.force_spread / steps);
    found.kinetic /= steps;
    found.sweeps /= steps;
    found.outside = static_cast<double>(count - state.count());
    for (const Vec3& x : state.position) found.outside += !box.contains(x);
    return found;
}

} // namespace

TEST_CASE("37 a ball of 50 d on two layers", "[hard]")
{
    // Mass ratio 1:125 000. Near the middle ball and floor are so nearly parallel that friction holds the grains
    // between them (half of the angle between the faces is less than atan 0.5 up to 20 d from it), so the ball comes to
    // rest on grains, whatever its weight. It is set onto them, and dropped by two diameters. Nothing is faster than
    // what a wedge of ball and floor squeezes out, the ball's speed if it fell to the floor over tan ψ (as in case 8).
    // A grain that overlaps by half a diameter is as good as through the floor; some hundred grains bear a thousand
    // times their weight each, and the ball must lie on them, not in them: a quarter at rest.
    HardCase hard("37 a ball of 50 d on two layers");
    for (const std::string law : {"matched", "projected"})
        for (const double bottom : {2.2, 4.2}) {
            const Load found = carry(law, bottom * d);
            const std::string name = law + (bottom < 3 ? ", set onto them: " : ", dropped: ");
            const double limit = std::sqrt(2 * gravity * bottom * d) / tan_wedge;
            hard.between(name + "grains with the centre below the floor", found.through, 0, 0);
            hard.between(
                name + "spheres out of the box at the end, and incidents", found.outside + found.incidents, 0, 0);
            hard.below(name + "fastest speed [sqrt(2 g H) / tan psi]", found.fastest / limit, 1.0);
            hard.below(name + "worst overlap at all [d]", found.deepest, 0.5);
            hard.below(name + "worst overlap at rest [d]", found.worst, 0.25);
            hard.above(name + "lowest point of the ball [d]", found.bottom, 0.5);
            hard.below(name + "mean force on the box, error", found.force_error, 0.01);
            hard.below(name + "kinetic energy at rest [weight x d]", found.kinetic, 1e-4);
            hard.tell(name + "force on the box in a step, rms error", found.force_spread);
            hard.tell(name + "sweeps at rest", found.sweeps);
        }
}
