// SPDX-License-Identifier: GPL-3.0-or-later
#include "loaded_bed.hpp"

#include "tests/validation/run_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace talus::test
{

Simulation bed_at_rest(int layers, int seed)
{
    auto s =
        open_scene("tube", {"seed=" + std::to_string(seed), "fill.0.count=" + std::to_string(grains_per_layer * layers),
                               "solver.stabilisation='projected'", "solver.pressure_scaling=true",
                               "fill.0.region.max=[0.044, 0.044, 6.0]", "wall.tube.max=[0.044, 0.044, 6.0]"});
    run_until(s, 1.0 + 0.01 * layers);
    return s;
}

std::size_t steps_until_carried(const std::vector<double>& errors)
{
    constexpr std::size_t window = 100;
    std::size_t begin = 0;
    const auto mean = [&] {
        const auto first = errors.begin() + static_cast<std::ptrdiff_t>(begin);
        return std::accumulate(first, first + window, 0.0) / window;
    };
    while (begin + window <= errors.size() && (errors[begin] > 0.05 || mean() > 0.05)) ++begin;
    return begin + window <= errors.size() ? begin + 1 : errors.size();
}

double center_height(const State& state)
{
    double sum = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        sum += state.mass(i) * state.position[i].z();
        mass += state.mass(i);
    }
    return sum / mass;
}

LoadedBed::LoadedBed(const Simulation& bed, double end)
    : model(bed.model), state_(bed.state), network_(bed.network), momentum_(bed.state.count())
{
    std::vector<double> height(state_.count());
    for (std::size_t i = 0; i < state_.count(); ++i) {
        if (state_.position[i].x() > end) continue;
        from_top_.push_back(state_.id[i]);
        height[static_cast<std::size_t>(state_.id[i])] = state_.position[i].z();
        weight_ += state_.mass(i) * model.gravity.norm();
    }
    std::ranges::sort(from_top_,
        [&](auto a, auto b) { return height[static_cast<std::size_t>(a)] > height[static_cast<std::size_t>(b)]; });
}

StepReport LoadedBed::step()
{
    const double h = model.time_step;
    for (std::size_t i = 0; i < state_.count(); ++i)
        momentum_[static_cast<std::size_t>(state_.id[i])] = state_.mass(i) * state_.body(i).velocity.z();
    for (int t = 0; t < grains_per_layer; ++t) {
        const auto i = std::ranges::find(state_.id, from_top_[static_cast<std::size_t>(t)]) - state_.id.begin();
        Body& m = state_.body(static_cast<std::size_t>(i));
        m.velocity.z() -= h * 0.25 * weight_ / grains_per_layer * m.inverse_mass;
    }
    return advance(state_, network_, model);
}

double LoadedBed::profile_error() const
{
    std::vector<double> gained(state_.count());
    for (std::size_t i = 0; i < state_.count(); ++i) {
        const auto id = static_cast<std::size_t>(state_.id[i]);
        gained[id] = momentum_[id] - state_.mass(i) * state_.body(i).velocity.z();
    }
    double above = 0.0, worst = 0.0;
    for (const auto id : from_top_) {
        above += gained[static_cast<std::size_t>(id)];
        worst = std::max(worst, std::abs(above) / (1.25 * model.time_step * weight_));
    }
    return worst;
}

} // namespace talus::test
