// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/diagnostics.hpp"
#include "core/step/time_step.hpp"

#include <algorithm>

namespace talus::test
{

/// Kinetic energy, and the potential one at x − h v/2, which free flight keeps in steps [J].
inline double energy_of_flight(const State& state, const Model& model)
{
    return kinetic_energy(state) + potential_energy(state, model.gravity) +
           0.5 * model.time_step * model.gravity.dot(linear_momentum(state));
}

/// Energy from step to step as METHOD (energy) counts it, that of springs included. What pushing out and moves of
/// positions put in stands in columns of its own, so that it is no rise.
class EnergyBooks
{
public:
    /// @param flight energy_of_flight at the start [J]
    explicit EnergyBooks(double flight) : complete_(flight), flight_(flight) {}

    /// Enters a step. Returns by how much the energy had risen until it began [J].
    /// @param flight energy_of_flight after it [J]
    double enter(const StepReport& report, double flight)
    {
        const double before = complete_ + put_in_ + report.contacts.push_out_energy;
        complete_ = flight_ + report.contacts.stored_energy;
        flight_ = flight;
        put_in_ = report.outcome.push_out_energy + report.lifted_energy;
        return std::max(0.0, complete_ - before);
    }

    double complete() const { return complete_; } ///< when the last step began [J]

private:
    double complete_, flight_, put_in_ = 0.0;
};

} // namespace talus::test
