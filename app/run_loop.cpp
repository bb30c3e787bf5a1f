// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_loop.hpp"

#include <fmt/format.h>

namespace talus
{
namespace
{

/// A share of a step; when no more than that is missing to the end, only rounding is to blame.
constexpr double negligible_step = 1e-3;

std::vector<std::string> metrics_columns(const Simulation& simulation)
{
    std::vector<std::string> columns = {"time_s", "spheres", "inserted", "left", "contacts", "sweeps", "residual",
        "worst_overlap_d", "mean_overlap_d", "kinetic_energy_J", "potential_energy_J", "contact_energy_J"};
    for (const auto& sensor : simulation.sensors)
        for (const Measurement& m : sensor->latest())
            columns.push_back(column_name(fmt::format("{}_{}", sensor->name, m.name), m.unit));
    return columns;
}

std::vector<bool> standing_walls(const Model& model, double time)
{
    std::vector<bool> standing;
    for (const Wall& wall : model.walls) standing.push_back(wall.stands_at(time));
    return standing;
}

} // namespace

RunLoop::RunLoop(
    Simulation& simulation, const scene::Scene& scene, const std::filesystem::path& folder, Progress& progress)
    : simulation_(simulation), folder_(folder), progress_(progress), frames_(folder),
      metrics_(folder / "metrics.csv", metrics_columns(simulation)), metrics_schedule_(scene.time.metrics_interval),
      particle_schedule_(scene.time.frame_interval), contact_schedule_(scene.output.contact_interval)
{
}

std::vector<Incident> RunLoop::run()
{
    const double end = simulation_.duration - negligible_step * simulation_.model.time_step;
    write_walls();
    particle_schedule_.due(simulation_.state.time);
    write_particles();

    StepReport report;
    while (simulation_.state.time < end && report.incidents.empty()) {
        report = make_step();
        write_what_is_due(report);
        progress_.update(simulation_, report, clock_.wall());
    }
    write_the_rest(report);
    progress_.finish();
    clock_.begin(RunPhase::output); // so that the phases add up to the whole
    return report.incidents;
}

StepReport RunLoop::make_step()
{
    clock_.begin(RunPhase::pour_and_outlet);
    StepReport report = step(simulation_, [this](Phase phase) { clock_.begin(phase); });
    clock_.begin(RunPhase::output);
    statistics_.add(report, simulation_);
    if (report.incidents.empty())
        for (const auto& sensor : simulation_.sensors) sensor->watch(snapshot(simulation_, report));
    return report;
}

void RunLoop::write_what_is_due(const StepReport& report)
{
    if (!report.incidents.empty()) return; // the end of the run writes it all, but asks no sensor about a broken state
    const double time = simulation_.state.time;
    if (standing_walls(simulation_.model, time) != standing_) write_walls();
    if (metrics_schedule_.due(time)) {
        sample_sensors(report);
        write_metrics(report);
    }
    if (contact_schedule_.due(time)) write_contacts();
    if (particle_schedule_.due(time)) {
        if (simulation_.model.physics.moving_walls) write_walls();
        write_particles();
        progress_.frame_written(simulation_, report, clock_.wall());
    }
}

void RunLoop::write_the_rest(const StepReport& report)
{
    const std::int64_t steps = simulation_.state.steps;
    if (last_particles_ != steps) {
        if (simulation_.model.physics.moving_walls) write_walls();
        write_particles();
    }
    if (steps == 0) return; // contacts and metrics speak of a step
    if (last_contacts_ != steps && report.incidents.empty()) write_contacts();
    if (last_metrics_ != steps) {
        if (report.incidents.empty()) sample_sensors(report);
        write_metrics(report);
    }
    write_tables();
}

void RunLoop::sample_sensors(const StepReport& report)
{
    clock_.begin(RunPhase::sensors);
    for (const auto& sensor : simulation_.sensors) sensor->sample(snapshot(simulation_, report));
    clock_.begin(RunPhase::output);
}

void RunLoop::write_metrics(const StepReport& report)
{
    const State& state = simulation_.state;
    const double d = simulation_.model.mean_diameter;
    std::vector<double> row = {state.time, static_cast<double>(state.count()), static_cast<double>(state.next_id),
        static_cast<double>(simulation_.outflow.count), static_cast<double>(report.contacts),
        static_cast<double>(report.sweeps), report.residual, report.worst_overlap / d, report.mean_overlap / d,
        report.kinetic_energy, report.potential_energy, report.contact_energy};
    for (const auto& sensor : simulation_.sensors)
        for (const Measurement& m : sensor->latest()) row.push_back(m.value);
    metrics_.add_row(row);
    last_metrics_ = state.steps;
}

void RunLoop::write_tables()
{
    for (const auto& sensor : simulation_.sensors)
        if (const auto table = sensor->table()) write_table(folder_, sensor->name, *table);
}

void RunLoop::write_particles()
{
    frames_.write_particles(simulation_);
    last_particles_ = simulation_.state.steps;
}

void RunLoop::write_contacts()
{
    frames_.write_contacts(simulation_);
    last_contacts_ = simulation_.state.steps;
}

void RunLoop::write_walls()
{
    frames_.write_walls(simulation_.model, simulation_.state.time);
    standing_ = standing_walls(simulation_.model, simulation_.state.time);
}

} // namespace talus
