// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/sensors/sensor.hpp"
#include "core/simulation/interventions.hpp"
#include "core/step/time_step.hpp"
#include "core/supply/pour.hpp"
#include "core/supply/removal.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace talus
{

/// What is done about the incidents of a step (world.on_escape, solver.on_no_solution); by default each of them ends
/// the run.
struct IncidentPolicy {
    bool remove_escaped = false; ///< a sphere that escaped is taken out of the world, and the run goes on
    bool go_on_pressed = false;  ///< bodies that are pressed together without a solution yield, and the run goes on

    /// Whether an incident of this step ends the run.
    bool stops(const StepReport& report) const;
};

/// A simulation ready to run: the constant model, the state, and what feeds, empties and watches it.
struct Simulation {
    Model model;
    State state;
    ContactNetwork network;
    std::vector<Pour> pours;
    Outflow outflow;
    IncidentPolicy incident_policy;
    std::vector<EscapedSphere> escaped; ///< and taken out, where the scene says so
    Interventions interventions;
    std::vector<std::unique_ptr<Sensor>> sensors;
    double duration = 0.0; ///< [s]

    /// All that changes in a run; the rest follows from the scene.
    /// @throws ArchiveError where what is put back is not whole, or of a scene with other kinds of impulses
    void persist(Archive& archive);

    /// The same without what sensors have seen: for a simulation with other sensors.
    void persist_without_sensors(Archive& archive);
};

/// Derives what follows from the rest of a simulation, once its materials, walls, spheres and pours are there: what
/// must be modelled, the diameters, and the speed with which overlap is undone where none is given. A scene needs no
/// such call.
/// @pre there are spheres, or pours
void complete(Simulation& simulation);

/// The speed with which overlap is undone that no load has pressed [m/s]: as fast as a grain falls that falls by some
/// of its size; without gravity as much in a step as with it at the automatic step h = 0.0072 √(d/gravity).
double usual_push_out_speed(const Model& model);

/// The same simulation once more, without sensors: it goes on as the first one, bit for bit, and leaves it alone.
Simulation copy_without_sensors(const Simulation& simulation);

/// Lets poured spheres in, takes away (every tenth step) the spheres that have been in an outlet, and advances by one
/// step. Network and spheres belong together until the next call.
StepReport advance(Simulation& simulation, const PhaseObserver& observer = {});

/// The beginning of a step: spheres come and go, and `network` has the problem that the rest of it would solve.
PreparedStep prepare_step(Simulation& simulation);

/// What is done between the steps of `run_until`; any of it may be left out.
struct StepHooks {
    std::function<bool()> before_step = {};                 ///< whether to make the step; else the run stops there
    std::function<void(const StepReport&)> after_step = {}; ///< of every step, the last one included
    PhaseObserver on_phase = {};
};

/// Makes steps until the simulation has reached this time, or up to the first step with an incident that stops it. What
/// escaped and does not stop it is taken out before the next step.
/// @param time [s]
/// @param last report of the step before, where there was one
/// @return the report of the last step; where none was made, `last`
StepReport run_until(Simulation& simulation, double time, const StepHooks& hooks, StepReport last = {});

/// Whether the simulation is at this time, or past it, up to a thousandth of a step, for which only rounding is to
/// blame.
/// @param steps_ahead to make first
bool has_reached(const Simulation& simulation, double time, std::int64_t steps_ahead = 0);

/// What sensors look at after a step.
inline Snapshot snapshot(const Simulation& simulation, const StepReport& report)
{
    return {simulation.state, simulation.model, simulation.network, report};
}

/// Lets the sensors watch a step.
/// @param due whether they take a sample, too
void show_to_sensors(const Simulation& simulation, const StepReport& report, bool due);

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
