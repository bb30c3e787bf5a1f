// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"
#include "loaded_bed.hpp"

#include "tests/support/median.hpp"
#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace talus;
using namespace talus::test;

namespace
{

struct Flow {
    double overlap = 0.0;        ///< mean over contacts and steps from `from` on [d]
    double sweeps = 0.0;         ///< mean over the same steps
    double kinetic_energy = 0.0; ///< mean over the same steps [J]
};

/// A scene under `projected`, without relaxation, which there is not where pressures are scaled; watched over the
/// second part of its time.
Flow watch(const std::string& scene, std::vector<std::string> overrides, bool scaled, double from, double to)
{
    overrides.push_back("solver.stabilisation=projected");
    overrides.push_back("solver.relaxation=1");
    overrides.push_back(std::string("solver.pressure_scaling=") + (scaled ? "true" : "false"));
    auto s = open_scene(scene, overrides);
    run_until(s, from);
    Flow flow;
    int steps = 0;
    for (; s.state.time < to; ++steps) {
        const auto report = advance(s);
        flow.overlap += report.contacts.mean_overlap() / s.model.mean_diameter;
        flow.sweeps += report.solve.sweeps;
        flow.kinetic_energy += report.bodies.kinetic_energy;
    }
    flow.overlap /= steps;
    flow.sweeps /= steps;
    flow.kinetic_energy /= steps;
    return flow;
}

/// Asks of the scaled flow that it overlaps little more than the other.
void compare(HardCase& hard, const std::string& name, const std::string& scene,
    const std::vector<std::string>& overrides, double from, double to)
{
    const Flow scaled = watch(scene, overrides, true, from, to), plain = watch(scene, overrides, false, from, to);
    hard.below(name + ": mean overlap [that of plain sweeps]", scaled.overlap / plain.overlap, 2);
    hard.below(name + ": sweeps [plain]", scaled.sweeps / plain.sweeps, 1.1);
    hard.between(name + ": kinetic energy [plain]", scaled.kinetic_energy / plain.kinetic_energy, 0.9, 1.1);
    hard.tell(name + ", plain: mean overlap [d]", plain.overlap);
    hard.tell(name + ", plain: sweeps", plain.sweeps);
}

/// How far the centre of mass sinks or rises in so many steps [d].
double way_at_rest(const Simulation& bed, int steps)
{
    State state = bed.state;
    ContactNetwork network = bed.network;
    for (int k = 0; k < steps; ++k) advance(state, network, bed.model);
    return std::abs(center_height(state) - center_height(bed.state)) / bed.model.mean_diameter;
}

/// The mean force-profile error of steps 100 to 200 after the load, where only every n-th step scales; 0: none.
double mean_error(const Simulation& bed, int every)
{
    LoadedBed loaded(bed);
    double sum = 0.0;
    for (int k = 0; k < 200; ++k) {
        loaded.model.solver.pressure_scaling = every > 0 && k % every == 0;
        loaded.step();
        if (k >= 100) sum += loaded.profile_error() / 100;
    }
    return sum;
}

} // namespace

TEST_CASE("35 scaling of pressures in flows", "[hard]")
{
    // Where contacts open, impacts happen and friction slides, pressures have no pattern that keeps: there the
    // correction must do no harm. A hopper that empties, a bed on a floor that shakes: with scaling
    // and without. Overlap may be somewhat more: the correction takes out long waves, so at the
    // same residual more of what is left are contacts that close.
    HardCase hard("35 scaling of pressures in flows");
    compare(hard, "hopper", "hopper", {"fill.0.count=2500", "wall.gate.remove_at=0.4"}, 0.55, 1.0);
    compare(hard, "vibrated bed", "vibrated_bed", {}, 0.5, 1.0);
}

TEST_CASE("35 scaling of pressures at rest", "[hard]")
{
    // A bed at rest is left at rest. Two columns stand side by side, closer than a cell of the grid: a load on one is
    // carried down in it alone. And why there is a correction in every step: its impulses hold the momentum of the
    // stop, and act again as the next warm start, so that corrections now and then make the floor's force swing.
    HardCase hard("35 scaling of pressures at rest");
    // Between smooth walls a bed settles for long: one of three still does after four seconds, the way of the median is
    // that of rest. So is its error.
    std::vector<double> ways, scaled, now_and_then, plain;
    for (int seed = 1; seed <= 5; ++seed) {
        auto bed = bed_at_rest(30, seed);
        run_until(bed, 4.0);
        ways.push_back(way_at_rest(bed, 1000));
        scaled.push_back(mean_error(bed, 1));
        now_and_then.push_back(mean_error(bed, 5));
        plain.push_back(mean_error(bed, 0));
    }
    hard.below("way of the centre of mass in 1000 steps at rest, median of five beds [d]", median(ways), 1e-5);
    hard.below("load on 30 layers, scaled in every step: mean profile error of steps 100 to 200, median of five beds",
        median(scaled), 0.02);
    hard.tell("in every fifth", median(now_and_then));
    hard.tell("in none", median(plain));

    const auto carried = [&](bool scaling) {
        std::vector<double> sweeps;
        for (int seed = 1; seed <= 5; ++seed) {
            auto two = open_scene("two_tubes", {"seed=" + std::to_string(seed)});
            run_until(two, 1.3);
            LoadedBed left(two, 0.0445);
            left.model.solver.pressure_scaling = scaling;
            const LoadHistory history([&] { return left.step(); }, [&] { return left.profile_error(); });
            sweeps.push_back(history.sweeps_until_carried());
        }
        return median(sweeps);
    };
    hard.below("two columns, one loaded: sweeps until its profile is within 5 %, median of five", carried(true), 100);
    hard.tell("without scaling", carried(false));
}
