// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/sensors/sensor.hpp"
#include "core/step/time_step.hpp"
#include "core/supply/escape.hpp"
#include "core/supply/outlet.hpp"
#include "core/supply/pour.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"
#include "scenarios/output_choice.hpp"

#include <memory>
#include <vector>

namespace talus
{

/// A simulation ready to run: the constant model, the state, and what feeds, empties and watches it.
struct Simulation {
    Model model;
    State state;
    ContactNetwork contacts;
    std::vector<Pour> pours;
    Outflow outflow;
    std::vector<EscapedSphere> escaped; ///< and taken out, where the scene says so
    std::vector<std::unique_ptr<Sensor>> sensors;
    OutputChoice output;
    double duration = 0.0; ///< [s]

    /// All that changes in a run; the rest follows from the scene.
    void persist(Archive& archive);
};

/// Lets poured spheres in, takes away (every tenth step) the spheres that have been in an outlet, and advances by one
/// step. Contacts and spheres belong together until the next call.
StepReport step(Simulation& simulation, const PhaseObserver& observer = {});

/// The beginning of a step: spheres come and go, and `contacts` has the problem that the rest of it would solve.
BegunStep begin_step(Simulation& simulation);

/// Whether the simulation is at this time, or past it, up to a thousandth of a step, for which only rounding is to
/// blame.
/// @param steps_ahead to make first
bool has_reached(const Simulation& simulation, double time, std::int64_t steps_ahead = 0);

/// What sensors look at after a step.
inline Snapshot snapshot(const Simulation& simulation, const StepReport& report)
{
    return {simulation.state, simulation.model, simulation.contacts, report};
}

/// Overlaps of the spheres as they lie: how many contacts, and the worst of them.
struct OverlapCheck {
    std::size_t count = 0;
    double worst = 0.0;     ///< [m]
    std::int64_t id_a = -1; ///< of the worst pair
    std::int64_t id_b = -1; ///< −1 where it is a wall
    std::int32_t wall = -1;
};
OverlapCheck check_overlaps(const Simulation& simulation);

} // namespace talus
