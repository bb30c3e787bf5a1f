// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/findings/findings.hpp"

#include "core/contacts/loads.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr std::size_t cut_count = 10;

double mass_of(const State& state)
{
    double mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) mass += state.mass(i);
    return mass;
}

double rms_speed(const State& state)
{
    double squares = 0.0;
    for (const Body& m : state.bodies) squares += m.velocity.squaredNorm();
    return state.count() > 0 ? std::sqrt(squares / static_cast<double>(state.count())) : 0.0;
}

/// An acceleration that is never zero, so that all can be divided by it.
double acceleration_of(const Simulation& start)
{
    const double g = start.model.gravity.norm();
    if (g > 0.0) return g;
    const double speed = rms_speed(start.state);
    return speed > 0.0 ? speed * speed / start.model.mean_diameter : 1.0;
}

} // namespace

StudyUnits::StudyUnits(const Simulation& start)
    : diameter(start.model.mean_diameter), acceleration(acceleration_of(start)),
      speed(std::sqrt(acceleration * diameter)), mass(mass_of(start.state)),
      grain_energy(mass / static_cast<double>(std::max<std::size_t>(1, start.state.count())) * acceleration * diameter)
{
}

Findings::Findings(const Simulation& start, double interval)
    : units_(start), up_(start.model.up()), looks_(interval), began_(start.state.time),
      momentum_(linear_momentum(start.state)), displacements_(start.state), cuts_(start.state, up_, cut_count),
      force_sum_(cut_count + 1)
{
    looks_.due(began_);
}

void Findings::add(const StepReport& report, Simulation& simulation)
{
    ++steps_;
    statistics_.add(report, simulation);
    add_momentum(report, simulation);
    for (const auto& sensor : simulation.sensors) sensor->watch(snapshot(simulation, report));
    if (looks_.due(simulation.state.time)) look(report, simulation);
}

void Findings::add_momentum(const StepReport& report, const Simulation& simulation)
{
    const Vec3 momentum = report.bodies.momentum.linear;
    if (statistics_.same_spheres()) {
        const Vec3 put_in =
            report.bodies.from_gravity.linear + report.outcome.from_walls.impulse + report.outcome.from_pistons.impulse;
        const double unit = simulation.model.time_step * units_.mass * units_.acceleration;
        momentum_error_ = std::max(momentum_error_, (momentum - momentum_ - put_in).norm() / unit);
    }
    momentum_ = momentum;
}

void Findings::look(const StepReport& report, Simulation& simulation)
{
    const State& state = simulation.state;
    ++looked_;
    const auto forces = cuts_.forces(state, simulation.network, report, simulation.model.time_step);
    for (std::size_t k = 0; k < forces.size(); ++k) force_sum_[k] += forces[k];
    support_squares_ += forces[0] * forces[0];
    height_sum_ += packing_height(state, up_);
    restless_sum_ += energy_without_rattlers(state);
    const auto note = [&](const Contact& c) {
        if (c.gap < 0.0) overlaps_.add(-c.gap / units_.diameter);
    };
    for_each_loaded_sphere_contact(simulation.network, note);
    for_each_loaded_wall_contact(simulation.network, note);
    for (const auto& sensor : simulation.sensors) sensor->sample(snapshot(simulation, report));
}

std::vector<Measurement> Findings::results(const Simulation& simulation) const
{
    const ErrorSummary error = statistics_.error(simulation.model);
    const double window = simulation.state.time - began_;
    const double looks = static_cast<double>(looked_), weight = units_.mass * units_.acceleration;
    const double support = force_sum_[0] / looks;
    std::vector<Measurement> results = {
        {"residual", error.mean_residual, 0.0, "1"},
        {"residual_95", error.residual_95, 0.0, "1"},
        {"steps_at_cap", static_cast<double>(error.steps_at_cap) / static_cast<double>(steps_), 0.0, "1"},
        {"overlap", overlaps_.mean(), 0.0, "d"},
        {"overlap_95", overlaps_.percentile(0.95), 0.0, "d"},
        {"worst_overlap", overlaps_.worst(), 0.0, "d"},
        {"height", height_sum_ / looks / units_.diameter, 0.0, "d"},
        {"creep", displacements_.median(simulation.state) / units_.diameter / window, 0.0, "d/s"},
        {"restlessness", restless_sum_ / looks / units_.grain_energy, 0.0, "m g d"},
        {"support_swing", std::sqrt(std::max(0.0, support_squares_ / looks - support * support)) / weight, 0.0, "M g"},
        {"energy_gained", error.energy_gained / (weight * units_.diameter) / window, 0.0, "M g d/s"},
        {"momentum_error", momentum_error_, 0.0, "M g h"},
    };
    for (const auto& sensor : simulation.sensors)
        for (Measurement m : sensor->results()) {
            m.name = sensor->name + " " + m.name;
            results.push_back(m);
        }
    return results;
}

std::vector<double> Findings::profile() const
{
    std::vector<double> mean = force_sum_;
    for (double& force : mean) force /= static_cast<double>(looked_) * units_.mass * units_.acceleration;
    return mean;
}

} // namespace talus
