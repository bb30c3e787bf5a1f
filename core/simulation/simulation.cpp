// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/simulation.hpp"

#include "core/candidates/neighbor_search.hpp"
#include "core/step/time_step.hpp"
#include "core/supply/diameters.hpp"
#include "core/world/placed_wall.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr std::int64_t outlet_interval =
    10; ///< steps between two emptyings of the outlets, each of which renumbers all spheres

/// Lets poured spheres in and takes away those that have been in an outlet.
Exchange let_in_and_out(Simulation& simulation)
{
    State& state = simulation.state;
    const Model& model = simulation.model;
    Exchange exchange;
    const std::size_t there = state.count();
    for (auto& source : simulation.pours) pour(source, state, model);
    for (std::size_t i = there; i < state.count(); ++i) exchange.energy += sphere_energy(state, model, i);
    exchange.came = static_cast<std::int64_t>(state.count() - there);
    if (state.steps % outlet_interval != 0) return exchange;
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (!state.leaving[i]) continue;
        ++exchange.left;
        exchange.energy -= sphere_energy(state, model, i);
    }
    empty_outlets(simulation.outflow, state, simulation.network);
    return exchange;
}

} // namespace

void Simulation::persist(Archive& archive)
{
    persist_without_sensors(archive);
    for (const auto& sensor : sensors) archive(*sensor);
}

void Simulation::persist_without_sensors(Archive& archive)
{
    bool rolling = model.physics.rolling; // decides which impulses are carried
    archive(rolling);
    if (rolling != model.physics.rolling) throw ArchiveError("it is of a scene with another rolling resistance");
    archive(state, network, pours, outflow, escaped);
    interventions.persist(archive, model);
    if (archive.reading()) network.contacts.clear(); // they are of another state
}

void complete(Simulation& simulation)
{
    Model& model = simulation.model;
    model.physics = model.needed_physics();
    Diameters diameters;
    for (std::size_t i = 0; i < simulation.state.count(); ++i) diameters.add(2.0 * simulation.state.radius[i]);
    for (const Pour& pour : simulation.pours) diameters.add(pour.mixture, expected_count(pour, model.materials));
    diameters.put_into(model);
    if (model.solver.push_out_speed == infinity) model.solver.push_out_speed = usual_push_out_speed(model);
}

double usual_push_out_speed(const Model& model)
{
    const double gravity = model.gravity.norm();
    return gravity > 0.0 ? 0.1 * std::sqrt(model.mean_diameter * gravity)
                         : 0.00072 * model.mean_diameter / model.time_step;
}

Simulation copy_without_sensors(const Simulation& simulation)
{
    Simulation copy;
    copy.model = simulation.model;
    copy.state = simulation.state;
    copy.network.list = simulation.network.list; // of the network, what a checkpoint keeps
    copy.network.carried = simulation.network.carried;
    copy.pours = simulation.pours;
    copy.outflow = simulation.outflow;
    copy.incident_policy = simulation.incident_policy;
    copy.escaped = simulation.escaped;
    copy.interventions = simulation.interventions;
    copy.duration = simulation.duration;
    return copy;
}

bool IncidentPolicy::stops(const StepReport& report) const
{
    return std::ranges::any_of(report.bodies.incidents, [&](const Incident& incident) {
        const bool may_be_removed = incident.kind == Incident::Kind::escaped && !incident.of_piston();
        const bool may_yield = incident.kind == Incident::Kind::pressed;
        return !incident.is_harmless() && !(may_be_removed && remove_escaped) && !(may_yield && go_on_pressed);
    });
}

StepReport advance(Simulation& simulation, const PhaseObserver& observer)
{
    const Exchange exchange = let_in_and_out(simulation);
    StepReport report = advance(simulation.state, simulation.network, simulation.model, observer);
    report.exchange = exchange;
    return report;
}

PreparedStep prepare_step(Simulation& simulation)
{
    let_in_and_out(simulation);
    return prepare_step(simulation.state, simulation.network, simulation.model, {simulation.model.time_step});
}

StepReport run_until(Simulation& simulation, double time, const StepHooks& hooks, StepReport report)
{
    while (!has_reached(simulation, time) && !simulation.incident_policy.stops(report)) {
        if (!report.bodies.incidents.empty())
            remove_escaped(simulation.escaped, simulation.state, simulation.network, report.bodies.incidents);
        if (hooks.before_step && !hooks.before_step()) break;
        report = advance(simulation, hooks.on_phase);
        if (hooks.after_step) hooks.after_step(report);
    }
    return report;
}

bool has_reached(const Simulation& simulation, double time, std::int64_t steps_ahead)
{
    constexpr double negligible_step = 1e-3;
    const double h = simulation.model.time_step;
    return static_cast<double>(simulation.state.steps + steps_ahead) * h >= time - negligible_step * h;
}

void show_to_sensors(const Simulation& simulation, const StepReport& report, bool due)
{
    for (const auto& sensor : simulation.sensors) {
        sensor->watch(snapshot(simulation, report));
        if (due) sensor->sample(snapshot(simulation, report));
    }
}

OverlapCheck check_overlaps(const Simulation& simulation)
{
    const auto& state = simulation.state;
    OverlapCheck check;
    const auto note = [&](double overlap, std::int64_t id_a, std::int64_t id_b, std::int32_t wall) {
        if (overlap <= 0.0) return;
        ++check.count;
        if (overlap <= check.worst) return;
        check.worst = overlap;
        check.id_a = id_a;
        check.id_b = id_b;
        check.wall = wall;
    };

    std::vector<Box> boxes;
    for (std::size_t i = 0; i < state.count(); ++i)
        boxes.push_back(Box{state.position[i], state.position[i]}.grown(state.radius[i]));
    const auto& periodicity = simulation.model.periodicity;
    for (const auto& [a, b] : find_box_pairs(boxes, periodicity))
        note(
            state.radius[a] + state.radius[b] - periodicity.nearest_image(state.position[a] - state.position[b]).norm(),
            state.id[a], state.id[b], -1);

    const auto walls = place_walls(simulation.model, state);
    for (std::size_t i = 0; i < state.count(); ++i)
        for (std::size_t w = 0; w < walls.size(); ++w)
            if (walls[w].stands())
                note(-walls[w].gap(state.position[i], state.radius[i]), state.id[i], -1, static_cast<std::int32_t>(w));
    return check;
}

} // namespace talus
