// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double start = 0.4, gravity = 9.81, d = 0.01;                // s, when it begins to move; m/s²; m
constexpr double before = 0.02, length = 0.2, width = 0.08, top = 0.4; // of blade and box [m]
const double slide = std::sqrt(2 * gravity * 3 * d);                   ///< speed of what falls by three diameters [m/s]

/// What happens from when the blade moves on.
struct Cut {
    double fastest = 0.0;   ///< of any grain in any step [m/s]
    double worst = 0.0;     ///< overlap [d]
    double outside = 0.0;   ///< most centres out of the box, or not numbers
    double incidents = 0.0; ///< escapes and presses
    double passed = 0.0;    ///< most centres behind the blade
};

/// Where a blade that moves along x is [m].
double place(double time, double speed, double way)
{
    return before + std::clamp(speed * (time - start), 0.0, way);
}

Cut cut(const std::vector<std::string>& overrides, double speed, double way, bool along)
{
    auto simulation = open_scene("blade", overrides);
    const Box box{Vec3::Zero(), Vec3(length, width, top)};
    const auto& state = simulation.state;
    Cut found;
    const auto watch = [&](const StepReport& report) {
        found.incidents += static_cast<double>(report.bodies.incidents.size());
        if (state.time < start) return;
        found.fastest = std::max(found.fastest, report.bodies.fastest_speed);
        found.worst = std::max(found.worst, report.contacts.worst_overlap / d);
        double outside = 0.0, passed = 0.0;
        for (const Vec3& x : state.position) {
            outside += !box.contains(x); // what is not a number is in no box
            passed += along && x.x() < place(state.time, speed, way);
        }
        found.outside = std::max(found.outside, outside);
        found.passed = std::max(found.passed, passed);
    };
    talus::run_until(simulation, start + way / speed + 0.2, {.after_step = watch});
    return found;
}

} // namespace

TEST_CASE("36 a thin blade between grains", "[hard]")
{
    // A blade without thickness, moved as told. It sweeps a bed from one end of a box, 0.2 d above the floor and as
    // wide and high as the box, so that no grain can be behind it; or it comes down into the bed, its edge between
    // grains, to 1.5 d above the floor, where a grain has room. A free grain that is struck leaves with (1 + e) V, one
    // that comes back from its neighbours and is struck again with (1 + e)² V at most, 2.25 V; three times V is
    // allowed, and the speed of what slides down by 3 d. Slowly, at a third of √(g d), grains lie on each other as
    // under a few times their weight. At ten times √(g d) a grain meets the blade in its way of some steps, 0.07 d
    // each; but by half a diameter it would be through.
    HardCase hard("36 a thin blade between grains");
    for (const std::string law : {"matched", "projected"})
        for (const double speed : {0.1, 3.0})
            for (const bool along : {true, false}) {
                const double way = along ? 8.0 * d : 11.0 * d;
                std::vector<std::string> overrides = {"solver.stabilisation=" + law,
                    fmt::format("wall.blade.motion.0.velocity=[{}, 0, {}]", along ? speed : 0.0, along ? 0.0 : -speed),
                    fmt::format("wall.blade.motion.0.to={}", start + way / speed)};
                if (!along) {
                    overrides.push_back("wall.blade.min=[0.1, 0, 0.125]");
                    overrides.push_back("wall.blade.max=[0.11, 0.08, 0.325]");
                    overrides.push_back("fill.0.region.min=[0, 0, 0]");
                    overrides.push_back("fill.0.region.max=[0.2, 0.08, 0.124]");
                }
                const Cut found = cut(overrides, speed, way, along);
                const auto name = fmt::format("{}, {} at {} m/s: ", law, along ? "sweeps" : "comes down", speed);
                hard.between(name + "grains out of the box, and incidents", found.outside + found.incidents, 0, 0);
                if (along) hard.between(name + "grains behind the blade", found.passed, 0, 0);
                hard.below(name + "fastest grain [3 V + sqrt(2 g 3 d)]", found.fastest / (3 * speed + slide), 1.0);
                hard.below(name + "worst overlap [d]", found.worst, speed < 1 ? 0.05 : 0.5);
            }
}
