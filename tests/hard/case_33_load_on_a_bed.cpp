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

struct Carried {
    std::vector<double> steps, sweeps; ///< until the load is carried, of each bed
    double beyond = 0.0;               ///< largest share of later steps with an error above 5 %, while grains move
    double sinking = 0.0;              ///< largest way of a centre of mass in all steps [d]
};

void load_top(Carried& carried, const Simulation& bed, bool scaled, int min_sweeps)
{
    LoadedBed loaded(bed);
    loaded.model.solver.pressure_scaling = scaled;
    loaded.model.solver.min_sweeps = min_sweeps;
    const LoadHistory history([&] { return loaded.step(); }, [&] { return loaded.profile_error(); });
    const auto& errors = history.errors;
    const auto when = history.steps_until_carried();
    const auto later = std::count_if(
        errors.begin() + static_cast<std::ptrdiff_t>(when), errors.end(), [](double e) { return e > 0.05; });
    carried.steps.push_back(static_cast<double>(when));
    carried.sweeps.push_back(history.sweeps_until_carried());
    if (when < errors.size())
        carried.beyond =
            std::max(carried.beyond, static_cast<double>(later) / static_cast<double>(errors.size() - when));
    carried.sinking =
        std::max(carried.sinking, (center_height(bed.state) - center_height(loaded.state())) / bed.model.mean_diameter);
}

void tell(HardCase& hard, const std::string& what, const Carried& carried)
{
    hard.tell(what + "steps", median(carried.steps));
    hard.tell(what + "largest share of later steps beyond 5 %", carried.beyond);
    hard.tell(what + "largest sinking of the centre of mass in 3000 steps [d]", carried.sinking);
}

void run(int layers, int beds)
{
    HardCase hard("33 a load on a bed of " + std::to_string(layers) + " layers");
    Carried scaled, other, plain;
    int other_sweeps = 0;
    for (int seed = 1; seed <= beds; ++seed) {
        const auto bed = bed_at_rest(layers, seed);
        const int usual = bed.model.solver.min_sweeps;
        other_sweeps = usual == 3 ? 6 : 3;
        load_top(scaled, bed, true, usual);
        load_top(other, bed, true, other_sweeps);
        load_top(plain, bed, false, usual);
    }
    hard.below("sweeps until the force profile is within 5 %, median", median(scaled.sweeps), layers < 100 ? 100 : 600);
    tell(hard, "", scaled);
    const std::string at_least = "at least " + std::to_string(other_sweeps) + " sweeps a step: ";
    hard.tell(at_least + "sweeps", median(other.sweeps));
    tell(hard, at_least, other);
    hard.tell("without scaling: sweeps", median(plain.sweeps));
    tell(hard, "without scaling: ", plain);
}

double vertical_momentum(const Model& model, const State& state)
{
    double sum = model.pistons[0].mass * state.pistons[0].velocity.z();
    for (std::size_t i = 0; i < state.count(); ++i) sum += state.mass(i) * state.body(i).velocity.z();
    return sum;
}

/// Of the moment at which the lid becomes heavier: what the floor does not carry yet, lid and grains gain.
double sweeps_until_lid_is_carried(const Simulation& bed, bool scaled)
{
    Model model = bed.model;
    State state = bed.state;
    ContactNetwork network = bed.network;
    model.solver.pressure_scaling = scaled;
    const double impulse = 1.25 * model.pistons[0].mass * model.gravity.norm() * model.time_step;
    double before = 0.0;
    const LoadHistory history(
        [&] {
            before = vertical_momentum(model, state);
            return advance(state, network, model);
        },
        [&] { return std::abs(vertical_momentum(model, state) - before) / impulse; });
    return history.sweeps_until_carried();
}

} // namespace

// Sweeps carry a change of load from contact to contact; rigid grains need about 0.4 n² ln(1/ε) of them through n
// layers. A correction of the pressures carries it at once. Law `projected`, production sweeps, three beds each. A
// hundred grains deep and more these are six a step, for three are too few to clean up after it.

TEST_CASE("33 a load on a bed of 20 layers", "[hard]")
{
    run(20, 3);
}

TEST_CASE("33 a load on a bed of 40 layers", "[hard]")
{
    run(40, 3);
}

TEST_CASE("33 a load on a bed of 80 layers", "[hard]")
{
    run(80, 3);
}

TEST_CASE("33 a load on a bed of 160 layers", "[hard]")
{
    run(160, 3);
}

TEST_CASE("33 a lid that becomes heavier", "[hard]")
{
    // Ten thousand grains' mass on a bed of thirty layers, and a quarter more of it from one step to the next.
    // In one bed of several a grain finds a new place meanwhile, so five are asked.
    HardCase hard("33 a lid that becomes heavier");
    std::vector<double> scaled, plain;
    bool unasked = true;
    for (int seed = 1; seed <= 5; ++seed) {
        auto s = open_scene("lid_on_bed", {"seed=" + std::to_string(seed)});
        run_until(s, 3.0);
        unasked = unasked && s.model.solver.pressure_scaling;
        scaled.push_back(sweeps_until_lid_is_carried(s, true));
        plain.push_back(sweeps_until_lid_is_carried(s, false));
    }
    hard.holds("pressures are scaled without being asked for", unasked);
    hard.below("sweeps until the floor's force is within 5 %, median", median(scaled), 10);
    for (const double sweeps : scaled) hard.tell("one bed: sweeps", sweeps);
    hard.tell("without scaling, median", median(plain));
}
