// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr int grains_per_layer = 16;

/// A bed of about so many layers at rest in a smooth tube 4.4 d wide: what its floor carries is what lies on it.
Simulation bed_at_rest(int layers)
{
    auto s = open_scene("tube", {"fill.0.count=" + std::to_string(grains_per_layer * layers),
                                    "solver.stabilisation='projected'", "solver.pressure_scaling=true",
                                    "fill.0.region.max=[0.044, 0.044, 6.0]", "wall.tube.max=[0.044, 0.044, 6.0]"});
    run_until(s, 1.0 + 0.01 * layers);
    return s;
}

struct Loading {
    double sweeps = 0.0;  ///< until the error stays below 5 %
    double steps = 0.0;   ///< likewise
    double sinking = 0.0; ///< of the centre of mass [d]
};

double center_height(const State& state)
{
    double sum = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        sum += state.mass(i) * state.position[i].z();
        mass += state.mass(i);
    }
    return sum / mass;
}

/// A quarter of the bed's weight is put on its top layer; the error is that of the force through the worst horizontal
/// cut, as a share of the force on the floor. A force through a cut is the weight and the load above it less what their
/// momentum has lost.
Loading load_top(const Simulation& bed, bool scaled, int steps)
{
    Model model = bed.model;
    State state = bed.state;
    ContactNetwork contacts = bed.contacts;
    model.solver.pressure_scaling = scaled;
    const double h = model.time_step;
    std::vector<std::int64_t> from_top = state.id;
    std::vector<double> height(from_top.size());
    for (std::size_t i = 0; i < state.count(); ++i)
        height[static_cast<std::size_t>(state.id[i])] = state.position[i].z();
    std::ranges::sort(from_top,
        [&](auto a, auto b) { return height[static_cast<std::size_t>(a)] > height[static_cast<std::size_t>(b)]; });
    double weight = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) weight += state.mass(i) * model.gravity.norm();
    const double load = 0.25 * weight / grains_per_layer;

    Loading out;
    const double height_before = center_height(state);
    double sweeps = 0.0;
    std::vector<double> momentum(from_top.size());
    for (int k = 1; k <= steps; ++k) {
        for (std::size_t i = 0; i < state.count(); ++i)
            momentum[static_cast<std::size_t>(state.id[i])] = state.mass(i) * state.motion[i].velocity.z();
        for (int t = 0; t < grains_per_layer; ++t) {
            const auto i = std::ranges::find(state.id, from_top[static_cast<std::size_t>(t)]) - state.id.begin();
            state.motion[static_cast<std::size_t>(i)].velocity.z() -=
                h * load * state.motion[static_cast<std::size_t>(i)].inverse_mass;
        }
        sweeps += advance(state, contacts, model).sweeps;
        std::vector<double> lost(from_top.size());
        for (std::size_t i = 0; i < state.count(); ++i) {
            const auto id = static_cast<std::size_t>(state.id[i]);
            lost[id] = momentum[id] - state.mass(i) * state.motion[i].velocity.z();
        }
        double above = 0.0, worst = 0.0;
        for (const auto id : from_top) {
            above += lost[static_cast<std::size_t>(id)];
            worst = std::max(worst, std::abs(above) / (1.25 * h * weight));
        }
        if (worst > 0.05) {
            out.sweeps = sweeps;
            out.steps = k;
        }
    }
    out.sinking = (height_before - center_height(state)) / model.mean_diameter;
    return out;
}

void run(int layers)
{
    HardCase hard("33 a load on a bed of " + std::to_string(layers) + " layers");
    const auto bed = bed_at_rest(layers);
    constexpr int steps = 3000;
    const Loading scaled = load_top(bed, true, steps), plain = load_top(bed, false, steps);
    hard.below("sweeps until the force profile stays within 5 %", scaled.sweeps, 200);
    hard.tell("steps", scaled.steps);
    hard.tell("sinking of the centre of mass [d]", scaled.sinking);
    hard.tell("without scaling: sweeps", plain.sweeps);
    hard.tell("without scaling: steps", plain.steps);
    hard.tell("without scaling: sinking [d]", plain.sinking);
}

} // namespace

// Sweeps carry a change of load from contact to contact; rigid grains need about 0.4 n² ln(1/ε) of them through n
// layers. A correction of the pressures carries it at once. Law `projected`, production sweeps.

TEST_CASE("33 a load on a bed of 20 layers", "[hard]")
{
    run(20);
}

TEST_CASE("33 a load on a bed of 40 layers", "[hard]")
{
    run(40);
}

TEST_CASE("33 a load on a bed of 80 layers", "[hard]")
{
    run(80);
}

TEST_CASE("33 a load on a bed of 160 layers", "[hard]")
{
    run(160);
}
