// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/findings/quietness.hpp"

#include <algorithm>
#include <numeric>

namespace talus
{
namespace
{

constexpr double liveliest = 0.02;

} // namespace

double energy_without_rattlers(const State& state)
{
    if (state.count() == 0) return 0.0;
    std::vector<double> energy;
    for (const Body& m : state.bodies) energy.push_back(m.kinetic_energy());
    const auto kept =
        energy.begin() + static_cast<std::ptrdiff_t>((1.0 - liveliest) * static_cast<double>(energy.size()));
    std::nth_element(energy.begin(), kept, energy.end());
    return kept == energy.begin()
               ? 0.0
               : std::accumulate(energy.begin(), kept, 0.0) / static_cast<double>(kept - energy.begin());
}

double packing_height(const State& state, const Vec3& up)
{
    double foot = infinity, mass = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const double height = up.dot(state.position[i]);
        foot = std::min(foot, height - state.radius[i]);
        mass += state.mass(i);
        moment += state.mass(i) * height;
    }
    return state.count() > 0 ? 2.0 * (moment / mass - foot) : 0.0;
}

Displacements::Displacements(const State& start)
{
    for (std::size_t i = 0; i < start.count(); ++i) start_[start.id[i]] = start.position[i];
}

double Displacements::median(const State& state) const
{
    std::vector<double> moved;
    for (std::size_t i = 0; i < state.count(); ++i)
        if (const auto start = start_.find(state.id[i]); start != start_.end())
            moved.push_back((state.position[i] - start->second).norm());
    if (moved.empty()) return 0.0;
    const auto middle = moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2);
    std::nth_element(moved.begin(), middle, moved.end());
    return *middle;
}

} // namespace talus
