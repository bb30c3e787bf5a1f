// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/run_report.hpp"

#include "app/system/terminal.hpp"
#include "scenarios/builder/checks.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

ParticleLedger particle_ledger(const Simulation& simulation, const std::vector<Incident>& incidents)
{
    ParticleLedger ledger;
    ledger.inserted = simulation.state.next_id;
    ledger.left = simulation.outflow.count;
    ledger.taken_out = simulation.interventions.taken_out;
    const auto still_listed = std::count_if(incidents.begin(), incidents.end(),
        [](const Incident& incident) { return incident.kind == Incident::Kind::escaped && !incident.of_piston(); });
    ledger.escaped = static_cast<std::int64_t>(simulation.escaped.size()) + still_listed;
    ledger.inside = static_cast<std::int64_t>(simulation.state.count()) - still_listed;
    return ledger;
}

std::string shortfall_of(const Pour& pour, double time, const Materials& materials)
{
    if (is_over(pour)) return "";
    if (!is_behind(pour, time, materials)) return "the run ended before the rest was due";
    return fmt::format("its region was full: {} times there was no free place", pour.refused);
}

std::vector<PourSummary> summarise_pours(const Simulation& simulation)
{
    std::vector<PourSummary> pours;
    for (const Pour& pour : simulation.pours) {
        PourSummary summary;
        summary.name = pour.name;
        summary.poured = pour.poured;
        summary.poured_mass = pour.poured_mass;
        if (std::isfinite(pour.mass))
            summary.asked_mass = pour.mass;
        else
            summary.asked = pour.count;
        summary.shortfall = shortfall_of(pour, simulation.state.time, simulation.model.materials);
        pours.push_back(summary);
    }
    return pours;
}

TimingSummary summarise_timing(const RunStatistics& statistics, const PhaseClock& clock)
{
    TimingSummary timing;
    timing.phases = clock.phases();
    for (const PhaseTime& phase : timing.phases) {
        timing.wall += phase.wall;
        timing.cpu += phase.cpu;
    }
    timing.contact_updates = statistics.contact_updates();
    timing.contact_update_rate = timing.contact_updates / timing.phases[static_cast<std::size_t>(RunPhase::sweeps)].cpu;
    return timing;
}

/// What the run was built as, without the choices that it did not have to make.
std::vector<Explanation> explanations(const BuildReport& report)
{
    std::vector<Explanation> list = {{"files", report.files}, {"accuracy", report.accuracy}, {"solver", report.solver},
        {"step", report.step}, {"model", report.model}, {"overlap", report.overlap}};
    std::erase_if(list, [](const Explanation& one) { return one.sentence.empty(); });
    return list;
}

/// " ± 0.0012 (step)"; where nothing is seen in the noise " ± below 0.0012 (step)".
std::string told(const ChangeOfResult& change, const char* by)
{
    if (!change.is_known()) return fmt::format(" ± ? ({})", by);
    const bool is_bound = !change.is_seen() && change.error() > 0.0;
    return fmt::format(" ± {}{:.2g} ({})", is_bound ? "below " : "", change.error(), by);
}

/// " ± 0.0021", and what companions have found.
std::string told_errors(const SensorSummary& sensor, std::size_t k)
{
    const Measurement& m = sensor.results[k];
    std::string text;
    if (m.spread != 0.0 && std::isfinite(m.spread))
        text = fmt::format(" ± {}{:.2g}", m.too_few ? "at least " : "", m.spread);
    if (k < sensor.by_step.size()) text += told(sensor.by_step[k], "step") + told(sensor.by_solver[k], "solver");
    return text;
}

/// Whether companions have made too few pieces for one of the results that there are.
bool has_too_few_pieces(const SensorSummary& sensor)
{
    for (std::size_t k = 0; k < sensor.by_step.size(); ++k)
        if (std::isfinite(sensor.results[k].value) && !sensor.by_step[k].is_known()) return true;
    return false;
}

void print_sensors(const RunSummary& summary)
{
    for (const SensorSummary& sensor : summary.sensors)
        for (std::size_t k = 0; k < sensor.results.size(); ++k) {
            const Measurement& m = sensor.results[k];
            const std::string name = fmt::format("{} {}", sensor.name, m.name);
            if (!std::isfinite(m.value))
                say("  {:<28} {}\n", name, sensor.silence);
            else
                say("  {:<28} {:.5g}{} {}{}\n", name, m.value, told_errors(sensor, k), m.unit,
                    std::isfinite(m.spread) ? "" : ", from too few samples for a spread");
        }
    for (const SensorSummary& sensor : summary.sensors) {
        if (std::ranges::any_of(
                sensor.results, [](const Measurement& m) { return m.too_few && std::isfinite(m.spread); }))
            say("  {:<28} {}\n", sensor.name, too_few_samples);
        if (has_too_few_pieces(sensor)) say("  {:<28} {}\n", sensor.name, too_few_pieces);
    }
}

/// What a sensor has to say at the end of a run, and if not all of it are numbers, why.
SensorSummary summarise(const Sensor& sensor, const scene::SensorTable& table, double time)
{
    SensorSummary summary{sensor.name, sensor.results(), "", std::max(0.0, std::min(table.to, time) - table.from)};
    if (std::ranges::all_of(summary.results, [](const Measurement& m) { return std::isfinite(m.value); }))
        return summary;
    summary.silence = table.from > time
                          ? fmt::format("it averages from {:.4g} s on, and the run ended at {:.4g} s", table.from, time)
                          : sensor.silence();
    return summary;
}

/// Adds what companions have found to the sensors, whose results are in their order.
void add_changes(std::vector<SensorSummary>& sensors, const Companions& companions)
{
    if (!companions.any()) return;
    std::size_t next = 0;
    for (SensorSummary& sensor : sensors)
        for (std::size_t k = 0; k < sensor.results.size(); ++k, ++next) {
            const ChangesOfResult changes = companions.of_result(next);
            sensor.by_step.push_back(changes.by_step());
            sensor.by_solver.push_back(changes.by_solver());
        }
}

/// "20 of 30 spheres", "0.2 of 0.3 kg".
std::string poured_of_asked(const PourSummary& pour)
{
    if (pour.asked_mass) return fmt::format("{:.4g} of {:.4g} kg", pour.poured_mass, *pour.asked_mass);
    return fmt::format("{} of {} spheres", pour.poured, pour.asked.value_or(0));
}

void print_ledger(const RunSummary& summary)
{
    const ParticleLedger& ledger = summary.ledger;
    const std::string taken_out =
        ledger.taken_out == 0 ? "" : fmt::format(" + {} taken out from outside", ledger.taken_out);
    say("  {:<28} {} inserted = {} inside + {} left through an outlet + {} escaped{} ({})\n", "spheres",
        ledger.inserted, ledger.inside, ledger.left, ledger.escaped, taken_out,
        ledger.closes() ? "closes" : "DOES NOT CLOSE: spheres were lost");
    for (const PourSummary& pour : summary.pours)
        if (!pour.shortfall.empty())
            say("  {:<28} {} came in: {}\n", fmt::format("pour {}", pour.name), poured_of_asked(pour), pour.shortfall);
}

void print_momentum(const char* name, const MomentumSums& sums, const char* unit)
{
    say("  {:<28} {:.4g} {} put in by gravity, {:.4g} by walls, {:.2g} left over\n", name, sums.from_gravity, unit,
        sums.from_walls, sums.left_over);
}

/// "0.12 %"; "unknown" where it is not a number.
std::string percent(double share)
{
    return std::isfinite(share) ? fmt::format("{:.2g} %", 100.0 * share) : "unknown";
}

void print_solver_error(const SolverErrorSummary& e)
{
    if (e.looks == 0) {
        say("  {:<28} unknown: the run was too short to look at it, see --error-estimate\n", "error of the solver");
        return;
    }
    say("  {:<28} {:.2g} m/s{}, {} of the flow's, {} of what contacts change\n", "error of velocities",
        e.velocity_error, std::isfinite(e.in_fall_speeds) ? fmt::format(", {:.2g} √(g d)", e.in_fall_speeds) : "",
        percent(e.of_flow), percent(e.of_contacts));
    say("  {:<28} {} of their mean\n", "error of contact forces", percent(e.force_error));
    for (const WallForceError& wall : e.walls)
        say("  {:<28} {:.2g} N of {:.4g} N\n", fmt::format("error of force on {}", wall.wall), wall.error, wall.force);
    say("  {:<28} {} steps solved again, {} of them a thousand times as well, all to a residual of {:.2g}; {} of the "
        "steps' work\n",
        "  from looks at", e.looks, e.to_the_end, e.residual, percent(e.share));
}

void print_error(const RunSummary& summary)
{
    const ErrorSummary& e = summary.error;
    const double steps = static_cast<double>(std::max<std::int64_t>(1, summary.steps));
    say("  {:<28} mean {:.2g}, 95 % of the steps below {:.2g}, worst {:.2g} (tolerance {:.2g})\n", "residual reached",
        e.mean_residual, e.residual_95, e.worst_residual, e.tolerance);
    say("  {:<28} {} of {} ({:.2g} %)\n", "steps at the cap of sweeps", e.steps_at_cap, summary.steps,
        100.0 * static_cast<double>(e.steps_at_cap) / steps);
    print_solver_error(summary.solver_error);
    if (summary.companion_pieces > 0)
        say("  {:<28} {} pieces of {:.3g} s made again: as they were, with another seed, with half the step, with a "
            "tenth of the tolerance\n",
            "companions", summary.companion_pieces, summary.companion_length);
    say("  {:<28} mean {:.2g} % d, worst {:.2g} % d at {:.4g} s\n", "overlap", 100.0 * e.mean_overlap,
        100.0 * e.worst_overlap, e.worst_overlap_time);
    if (e.split_steps > 0)
        say("  {:<28} {} of {}, into {} at most, for {}\n", "steps split", e.split_steps, summary.steps,
            e.most_sub_steps, describe(e.split_for, summary.wall_names));
    say("  {:<28} {:.2g} N s\n", "worst cone violation", e.cone_violation);
    if (e.corrections > 0)
        say("  {:<28} {} of {} ({:.2g} %)\n", "pressure corrections refused", e.refused_corrections, e.corrections,
            100.0 * static_cast<double>(e.refused_corrections) / static_cast<double>(e.corrections));
    const std::string put_in =
        e.energy_put_in == 0.0
            ? ""
            : fmt::format("; {:.4g} J put in by moving walls, loads or gravity along periodic axes", e.energy_put_in);
    say("  {:<28} {:.4g} J lost, {:.2g} J gained that nothing put in{}\n", "energy", e.energy_lost, e.energy_gained,
        put_in);
    print_momentum("momentum", e.linear, "N s");
    if (e.angular.left_over > 0.0) print_momentum("angular momentum", e.angular, "N m s");
}

void print_timing(const RunSummary& summary)
{
    const TimingSummary& timing = summary.timing;
    for (const PhaseTime& phase : timing.phases)
        say("  {:<28} {:>9.2f} s wall {:>9.2f} s CPU {:>6.1f} %\n", phase.name, phase.wall, phase.cpu,
            100.0 * phase.cpu / timing.cpu);
    say("  {:<28} {:>9.2f} s wall {:>9.2f} s CPU, threads: {}\n", "in all", timing.wall, timing.cpu, summary.threads);
    if (summary.steps == 0) return;
    say("  {:<28} {:.3g} s CPU for a simulated second, {:.0f} steps/s, {:.3g} million contact updates/s of "
        "sweep CPU\n",
        "rate", timing.cpu / summary.simulated_time, static_cast<double>(summary.steps) / timing.wall,
        1e-6 * timing.contact_update_rate);
}

} // namespace

RunSummary summarise(const OpenedScene& opened, const RunStatistics& statistics, const PhaseClock& clock,
    const std::vector<Incident>& incidents)
{
    const Simulation& simulation = opened.simulation;
    RunSummary summary;
    summary.incidents = incidents;
    summary.interrupted = incidents.empty() && !has_reached(simulation, simulation.duration);
    summary.touched = simulation.interventions.any;
    summary.wall_names = names_of(simulation.model.walls);
    summary.version = TALUS_VERSION;
    summary.scene = opened.name;
    summary.title = opened.scene.title;
    summary.seed = opened.scene.seed;
    summary.explanations = explanations(opened.report);
    summary.threads = omp_get_max_threads();
    summary.simulated_time = simulation.state.time;
    summary.time_step = simulation.model.time_step;
    summary.steps = simulation.state.steps;
    summary.ledger = particle_ledger(simulation, incidents);
    summary.pours = summarise_pours(simulation);
    for (std::size_t k = 0; k < simulation.sensors.size(); ++k)
        summary.sensors.push_back(summarise(*simulation.sensors[k], opened.scene.sensor[k], simulation.state.time));
    add_changes(summary.sensors, statistics.companions());
    summary.companion_pieces = statistics.companions().pieces();
    summary.companion_length = Companions::piece_length(simulation.model, opened.scene);
    summary.error = statistics.error(simulation.model);
    summary.solver_error = statistics.looks().summary(simulation.model);
    const auto watched = watched_walls(opened.scene, simulation.model);
    std::erase_if(summary.solver_error.walls, [&](const WallForceError& wall) {
        return std::ranges::none_of(
            watched, [&](std::size_t w) { return simulation.model.walls[w].name == wall.wall; });
    });
    summary.timing = summarise_timing(statistics, clock);
    return summary;
}

void print_results(const RunSummary& summary)
{
    say("\n{} {} at t = {:.6g} s after {} steps of {:.4g} s\n", summary.scene,
        !summary.incidents.empty() ? "FAILED"
        : summary.interrupted      ? "interrupted"
                                   : "done",
        summary.simulated_time, summary.steps, summary.time_step);
    if (summary.touched) say("its state was changed from outside: the scene alone does not lead to it\n");
    say("results\n");
    print_sensors(summary);
    print_ledger(summary);
    say("error of the run\n");
    print_error(summary);
    say("time\n");
    print_timing(summary);
    std::fflush(stdout); // before what follows on standard error
}

} // namespace talus
