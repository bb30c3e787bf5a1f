// SPDX-License-Identifier: GPL-3.0-or-later
#include "quietness.hpp"

#include "app/findings/quietness.hpp"

#include <algorithm>
#include <cmath>

namespace talus::test
{

Quietness watch(Simulation& simulation, double window)
{
    const auto& state = simulation.state;
    const auto& model = simulation.model;
    const double d = model.mean_diameter, g = model.gravity.norm();
    double mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) mass += state.mass(i);
    const Displacements displacements(state);

    Quietness quiet{.least_sweeps = static_cast<double>(model.solver.min_sweeps)};
    double squares = 0.0;
    std::int64_t steps = 0;
    const double end = state.time + window;
    while (state.time < end) {
        const auto report = advance(simulation);
        const double support = -report.outcome.from_walls.impulse.dot(model.gravity) / g / model.time_step;
        squares += std::pow(support / (mass * g) - 1.0, 2);
        quiet.overlap += report.contacts.mean_overlap() / d;
        quiet.worst_overlap = std::max(quiet.worst_overlap, report.contacts.worst_overlap / d);
        quiet.sweeps += report.solve.sweeps;
        quiet.restless += energy_without_rattlers(state);
        ++steps;
    }
    const auto count = static_cast<double>(steps);
    quiet.overlap /= count;
    quiet.sweeps /= count;
    quiet.restless /= count * mass / static_cast<double>(state.count()) * g * d;
    quiet.force_rms = std::sqrt(squares / count);
    quiet.height = packing_height(state, model.up()) / d;
    quiet.creep = displacements.median(state) / d / window;
    return quiet;
}

} // namespace talus::test
