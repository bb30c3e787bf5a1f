// SPDX-License-Identifier: GPL-3.0-or-later
#include "quietness.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace talus::test
{
namespace
{

constexpr double liveliest = 0.02; ///< a few rattlers roll for ever and would hide everything else in a plain mean

/// Mean kinetic energy of the grains but the liveliest [J].
double kinetic_energy_without_rattlers(const State& state)
{
    std::vector<double> energy;
    for (const auto& m : state.motion) energy.push_back(kinetic_energy(m));
    const auto kept = static_cast<std::size_t>((1.0 - liveliest) * static_cast<double>(energy.size()));
    std::nth_element(energy.begin(), energy.begin() + static_cast<std::ptrdiff_t>(kept), energy.end());
    double sum = 0.0;
    for (std::size_t k = 0; k < kept; ++k) sum += energy[k];
    return sum / static_cast<double>(kept);
}

double height(const State& state)
{
    double foot = infinity, mass = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        foot = std::min(foot, state.position[i][2] - state.radius(i));
        mass += state.mass(i);
        moment += state.mass(i) * state.position[i][2];
    }
    return 2.0 * (moment / mass - foot);
}

} // namespace

Quietness watch(Simulation& simulation, double window)
{
    const auto& state = simulation.state;
    const auto& model = simulation.model;
    const double d = model.mean_diameter, g = model.gravity.norm();
    double mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) mass += state.mass(i);
    std::map<std::int64_t, Vec3> start;
    for (std::size_t i = 0; i < state.count(); ++i) start[state.id[i]] = state.position[i];

    Quietness quiet;
    double squares = 0.0;
    std::int64_t steps = 0;
    const double end = state.time + window;
    while (state.time < end) {
        const auto report = step(simulation);
        const double support = -report.wall_impulse.dot(model.gravity) / g / model.time_step;
        squares += std::pow(support / (mass * g) - 1.0, 2);
        quiet.overlap += report.mean_overlap / d;
        quiet.worst_overlap = std::max(quiet.worst_overlap, report.worst_overlap / d);
        quiet.sweeps += report.sweeps;
        quiet.restless += kinetic_energy_without_rattlers(state);
        ++steps;
    }
    const auto count = static_cast<double>(steps);
    quiet.overlap /= count;
    quiet.sweeps /= count;
    quiet.restless /= count * mass / static_cast<double>(state.count()) * g * d;
    quiet.force_rms = std::sqrt(squares / count);
    quiet.height = height(state) / d;

    std::vector<double> moved;
    for (std::size_t i = 0; i < state.count(); ++i) moved.push_back((state.position[i] - start.at(state.id[i])).norm());
    std::nth_element(moved.begin(), moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2), moved.end());
    quiet.creep = moved[moved.size() / 2] / d / window;
    return quiet;
}

} // namespace talus::test
