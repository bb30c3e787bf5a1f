// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double automatic_step = 2.49e-4; ///< of both scenes [s]

struct Sample {
    double mean = 0.0, error = 0.0; ///< over the seeds, and its standard error
    double fastest = 0.0;           ///< speed that a sphere had [m/s]
};

/// A result of a small scene with a multiple of its automatic step.
Sample measure(const std::string& scene, std::vector<std::string> overrides, double multiple, int seeds,
    double duration, const std::string& sensor, const std::string& quantity)
{
    char step_override[60];
    std::snprintf(step_override, sizeof step_override, "time.step=%.6g", multiple * automatic_step);
    overrides.push_back(step_override);
    Sample sample;
    std::vector<double> values;
    for (int seed = 1; seed <= seeds; ++seed) {
        overrides.push_back("seed=" + std::to_string(seed));
        auto s = open_scene(scene, overrides);
        overrides.pop_back();
        sample.fastest = std::max(sample.fastest, run_until(s, duration));
        values.push_back(result(s, sensor, quantity).value);
    }
    for (const double value : values) sample.mean += value / seeds;
    for (const double value : values) sample.error += (value - sample.mean) * (value - sample.mean);
    sample.error = seeds > 1 ? std::sqrt(sample.error / (seeds - 1) / seeds) : 0.0;
    return sample;
}

} // namespace

TEST_CASE("11 time step", "[hard]")
{
    // Ten times the automatic step and a tenth of it. At ten times `matched` is a hundred times as soft, and overlap
    // that is undone at once would throw beads about; in the hopper those that have left move more than 0.2 d in a
    // step, for which it is split, all of it, so that the pile is the harder of the two.
    HardCase hard("11 time step");
    const std::vector<std::string> hopper = {
        "fill.0.count=2500", "wall.gate.remove_at=0.4", "sensor.outlet.from=0.55", "sensor.outlet.to=1.1"};
    const std::vector<std::string> pile = {
        "pour.source.count=1000", "wall.plate.radius=0.105", "wall.lip.radius=0.105"};
    const double fall_in_hopper = std::sqrt(2 * 9.81 * 0.7), fall_on_pile = std::sqrt(2 * 9.81 * 0.3) + 0.5;
    const auto rate = [&](double multiple, int seeds) {
        return measure("hopper", hopper, multiple, seeds, 1.1, "outlet", "mass_flow");
    };
    const auto angle = [&](double multiple, int seeds) {
        return measure("pile_plain", pile, multiple, seeds, 1.6, "heap", "angle");
    };
    const Sample usual = rate(1, 4), long_step = rate(10, 12), short_step = rate(0.1, 1);
    hard.tell("hopper: mass flow at the automatic step, four seeds [kg/s]", usual.mean);
    const double error = std::hypot(long_step.error, usual.error);
    hard.below("hopper, h x 10, twelve seeds: change of the mass flow [%]",
        100 * std::abs(long_step.mean / usual.mean - 1), 5);
    hard.tell("standard error [%]", 100 * error / usual.mean);
    hard.below(
        "hopper, h / 10, one seed: change of the mass flow [%]", 100 * std::abs(short_step.mean / usual.mean - 1), 5);
    hard.below(
        "hopper, h x 10: fastest sphere [free fall from the top + 1 m/s]", long_step.fastest / (fall_in_hopper + 1), 1);

    const Sample heap = angle(1, 12), long_heap = angle(10, 12), short_heap = angle(0.1, 12);
    hard.tell("pile: angle of repose at the automatic step, twelve seeds [degree]", heap.mean);
    hard.tell("standard error [degree]", heap.error);
    hard.below("pile, h x 10, twelve seeds: change of the angle [degree]", std::abs(long_heap.mean - heap.mean), 2);
    hard.below("pile, h / 10, twelve seeds: change of the angle [degree]", std::abs(short_heap.mean - heap.mean), 2);
    hard.below(
        "pile, h x 10: fastest sphere [free fall from the top + 1 m/s]", long_heap.fastest / (fall_on_pile + 1), 1);
}
