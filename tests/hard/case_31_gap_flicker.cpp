// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include "core/base/region.hpp"

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double h = automatic_step();

struct Flicker {
    double deviation = 0.0;   ///< of the impulse on the sphere [m g h]
    double error = 0.0;       ///< of its mean [m g h]
    bool persists = true;     ///< an impulse in every step
    int above = 0, steps = 0; ///< steps that began with g > 0, of so many
};

/// The impulses on a sphere on a plane, which before each step is pushed up or down by `noise`.
/// @param start its gap at the beginning
template <class Noise> Flicker flicker(double start, Stabilisation law, Noise&& noise)
{
    constexpr int settle = 200;
    World world = sphere_on_plane({.friction = 0.5}, production_settings(law), h);
    world.model.solver.push_out_speed = automatic_push_out_speed();
    world.state.position[0].z() += start;
    const double weight = world.mass() * standard_gravity;
    double sum = 0.0, squares = 0.0;
    Flicker result;
    for (int k = 0; k < settle + 10000; ++k) {
        world.state.position[0].z() += noise();
        const double gap = world.position().z() - standard_radius;
        world.step();
        if (k < settle) continue;
        const auto forces = world.contact_forces();
        const double load = forces.empty() ? 0.0 : forces[0].normal_force / weight;
        sum += load;
        squares += load * load;
        result.persists = result.persists && load > 0.0;
        result.above += gap > 0.0;
        ++result.steps;
    }
    const double mean = sum / result.steps;
    result.deviation = std::sqrt(std::max(0.0, squares / result.steps - mean * mean));
    result.error = std::abs(mean - 1.0);
    return result;
}

} // namespace

TEST_CASE("31 gap flicker", "[hard][quick]")
{
    // A sphere at rest whose gap is now above zero and now below, by rounding or a little more: a law that jumps at
    // g = 0, with contacts only where g ≤ 0 say, gives it m g h in one step and nothing in the next. Here an open gap
    // within reach is a contact too, u_n ≥ −g/h, and keeps its impulse. With `matched` a loaded contact at rest is
    // never at g = 0: it overlaps by 0.225 g h², that is 1.4e-5 d, so only `projected` can flicker.
    HardCase hard("31 gap flicker");
    const double fall = standard_gravity * h * h; // of a sphere in its first step
    for (const auto law : {Stabilisation::matched, Stabilisation::projected}) {
        const std::string name = name_of(law) + ": ";
        double deviation = 0.0, error = 0.0;
        bool persists = true;
        for (const double start : {-10 * fall, -fall, -1e-15, 0.0, 1e-15, 0.5 * fall, fall, 1e-3 * d}) {
            const auto rest = flicker(start, law, [] { return 0.0; });
            deviation = std::max(deviation, rest.deviation);
            error = std::max(error, rest.error);
            persists = persists && rest.persists;
        }
        hard.below(name + "std of the impulse, laid down at eight gaps [m g h]", deviation, 1e-3);
        hard.below(name + "error of its mean [m g h]", error, 1e-3);
        for (const double size : {1e-9 * d, 1e-3 * fall}) {
            Random random(31);
            const auto shaken = flicker(0.0, law, [&] { return size * (2 * uniform(random) - 1); });
            const std::string what = size < 1e-3 * fall ? "1e-9 d" : "1e-3 g h2";
            hard.below(name + "std with a noise of " + what + " a step [m g h]", shaken.deviation, 1e-3);
            hard.tell(name + "share of steps that begin with a gap above zero",
                static_cast<double>(shaken.above) / shaken.steps);
            persists = persists && shaken.persists;
        }
        hard.holds(name + "an impulse in every step", persists);
    }
}
