// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/run_loop.hpp"

#include "app/system/last_words.hpp"
#include "app/system/signals.hpp"
#include "app/system/terminal.hpp"
#include "io/run/checkpoint.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/checks.hpp"

namespace talus
{
namespace
{

/// Escapes, and presses, told one by one on standard error; the walls that appear inside spheres are all told.
constexpr std::size_t incidents_told = 5;

/// How often a checkpoint is taken and kept, for where a step fails: not more than so often by the clock [s], nor so
/// often that it costs more than so small a part of the time.
constexpr double keep_interval = 1.0, most_pains = 100.0;

std::vector<std::string> metrics_columns(const Simulation& simulation, const std::vector<std::size_t>& watched_walls)
{
    std::vector<std::string> columns = {"time_s", "spheres", "inserted", "left", "contacts", "sweeps", "residual",
        "worst_overlap_d", "mean_overlap_d", "kinetic_energy_J", "potential_energy_J", "contact_energy_J",
        "velocity_error_m_per_s", "velocity_error_of_flow", "velocity_error_of_contacts", "force_error"};
    if (simulation.model.physics.attraction) columns.emplace_back("attraction_energy_J");
    for (const std::size_t w : watched_walls)
        columns.push_back(column_name(fmt::format("{}_force_error", simulation.model.walls[w].name), "N"));
    for (const auto& sensor : simulation.sensors)
        for (const Measurement& m : sensor->latest())
            columns.push_back(column_name(fmt::format("{}_{}", sensor->name, m.name), m.unit));
    return columns;
}

/// For each wall whether it stands, and whether it moves, which one that is driven from outside begins to do.
std::vector<std::pair<bool, bool>> standing_walls(const Model& model, double time)
{
    std::vector<std::pair<bool, bool>> standing;
    for (const Wall& wall : model.walls) standing.emplace_back(wall.stands_at(time), wall.moves());
    return standing;
}

} // namespace

RunLoop::RunLoop(OpenedScene& opened, FolderLock& lock, Verbosity verbosity) : RunLoop(opened, lock, verbosity, nullptr)
{
}

RunLoop::RunLoop(OpenedScene& opened, FolderLock& lock, Verbosity verbosity, Archive& checkpoint)
    : RunLoop(opened, lock, verbosity, &checkpoint)
{
}

RunLoop::RunLoop(OpenedScene& opened, FolderLock& lock, Verbosity verbosity, Archive* checkpoint)
    : scene_(opened.scene), simulation_(opened.simulation), lock_(lock), folder_(lock.folder()),
      origin_(origin_of(opened.name, opened.scene)), wall_interval_(opened.scene.checkpoint.wall_interval),
      verbosity_(verbosity), metrics_schedule_(opened.scene.time.metrics_interval),
      particle_schedule_(opened.scene.time.frame_interval), contact_schedule_(opened.scene.output.contact_interval),
      checkpoint_schedule_(opened.scene.checkpoint.interval),
      watched_walls_(watched_walls(opened.scene, opened.simulation.model)), frames_(folder_, opened.output),
      progress_(verbosity, opened.simulation)
{
    if (checkpoint)
        go_on(*checkpoint);
    else
        begin();
}

void RunLoop::begin()
{
    note_checkpoint(folder_, std::nullopt);
    metrics_.emplace(folder_ / "metrics.csv", metrics_columns(simulation_, watched_walls_));
    write_walls();
    particle_schedule_.due(simulation_.state.time);
    write_particles();
    checkpoint_schedule_.due(simulation_.state.time);
}

void RunLoop::go_on(Archive& checkpoint)
{
    WrittenFile metrics;
    persist(checkpoint, metrics);
    if (!checkpoint.at_end()) throw ArchiveError("the saved state is longer than what this scene needs");
    recent_.bytes = checkpoint.take_bytes(); // room for the next one
    const double time = simulation_.state.time;
    if (has_reached(simulation_, simulation_.duration))
        throw InputError(fmt::format("{}: the run is at t = {:.6g} s already, and cannot end at {:.6g} s",
            folder_.string(), time, simulation_.duration));
    metrics_.emplace(folder_ / "metrics.csv", metrics_columns(simulation_, watched_walls_), metrics);
    progress_ = Progress(verbosity_, simulation_);
    frames_.cut_back();
    if (const auto damaged = frames_.damaged(); !damaged.empty())
        warn("{}: {} of the frames that were written {} no longer there or cut short, first {}; the run goes on "
             "without\n",
            folder_.string(), damaged.size(), damaged.size() == 1 ? "is" : "are", damaged.front());
    lost_ = simulation_.escaped.size();
    write_lost(folder_, simulation_.escaped);
    standing_ = standing_walls(simulation_.model, time);
    note_checkpoint(folder_, time);
    for (Schedule* schedule : {&particle_schedule_, &checkpoint_schedule_}) schedule->due(time);
    if (simulation_.state.steps == 0) return; // the first contacts and metrics are those of the first step
    for (Schedule* schedule : {&metrics_schedule_, &contact_schedule_}) schedule->due(time);
}

void RunLoop::estimate_error()
{
    statistics_.looks().set_share(ErrorLooks::large_share);
    statistics_.companions().set_share(Companions::usual_share);
}

RunEnd RunLoop::run()
{
    run_until(simulation_.duration);
    return end();
}

void RunLoop::run_until(double time, const std::function<bool()>& go_on)
{
    StepHooks hooks;
    hooks.before_step = [&] {
        if (go_on && !go_on()) return false;
        clock_.begin(RunPhase::companions);
        statistics_.companions().before_step(simulation_, scene_, [] { return stop_signal() == 0; });
        signal_ = stop_signal();
        before_step(signal_ != 0 || has_reached(simulation_, simulation_.duration, 1));
        if (signal_ != 0) return false;
        clock_.begin(RunPhase::looks);
        statistics_.looks().before_step(simulation_);
        clock_.begin(RunPhase::pour_and_outlet);
        return true;
    };
    hooks.after_step = [this](const StepReport& report) { after_step(report); };
    hooks.on_phase = [this](Phase phase) { clock_.begin(phase); };
    last_ = talus::run_until(simulation_, time, hooks, std::move(last_));
}

RunEnd RunLoop::end()
{
    RunEnd end{{}, signal_};
    const bool failed = simulation_.incident_policy.stops(last_);
    if (failed || has_reached(simulation_, simulation_.duration)) {
        write_the_rest(last_);
    } else if (signal_ == 0) {
        remove_escaped(simulation_.escaped, simulation_.state, simulation_.network, last_.bodies.incidents);
        before_step(true);
    }
    if (failed) {
        end.incidents = last_.bodies.incidents;
        write_checkpoint();
    }
    progress_.finish();
    clock_.begin(RunPhase::output); // so that the phases add up to the whole
    return end;
}

/// @param is_last whether the step is the last one, or is not to be made at all
void RunLoop::before_step(bool is_last)
{
    if (simulation_.escaped.size() > lost_) {
        lock_.hold();
        write_lost(folder_, simulation_.escaped);
        lost_ = simulation_.escaped.size();
    }
    const bool is_due = is_last || checkpoint_is_due();
    if (is_due || clock_.wall() - recent_.taken >= std::max(keep_interval, most_pains * recent_.pains))
        take_checkpoint();
    if (is_due) write_checkpoint();
}

void RunLoop::after_step(const StepReport& report)
{
    look_at_error(report);
    clock_.begin(RunPhase::output);
    statistics_.add(report, simulation_);
    if (!simulation_.incident_policy.stops(report)) {
        for (const auto& sensor : simulation_.sensors) sensor->watch(snapshot(simulation_, report));
        write_what_is_due(report); // the end of the run writes it all, but asks no sensor about a broken state
        tell_incidents(report);
    }
    progress_.update(simulation_, report, clock_.wall());
}

void RunLoop::look_at_error(const StepReport& report)
{
    clock_.begin(RunPhase::looks);
    statistics_.looks().after_step(simulation_, report);
    statistics_.companions().after_step(report);
}

void RunLoop::tell_incidents(const StepReport& report)
{
    std::size_t escapes = simulation_.escaped.size();
    for (const Incident& incident : report.bodies.incidents) {
        if (incident.is_harmless()) {
            progress_.finish();
            warn("t = {:.6g} s: {}; they are pushed out\n", simulation_.state.time,
                describe(incident, names_of(simulation_.model.walls)));
            continue;
        }
        const bool pressed = incident.kind == Incident::Kind::pressed;
        const std::size_t told = pressed ? presses_told_++ : escapes++;
        if (told > incidents_told) continue;
        progress_.finish();
        if (told == incidents_told)
            warn("further {}\n",
                pressed ? "presses are not reported" : "escapes are reported by the ledger and lost.vtp only");
        else
            warn("t = {:.6g} s: {}; {}\n", simulation_.state.time,
                describe(incident, names_of(simulation_.model.walls)), pressed ? "they yield" : "it is taken out");
    }
}

bool RunLoop::checkpoint_is_due()
{
    // each is asked, so that one does not come again for what the other has brought
    const bool by_signal = checkpoint_requested();
    const bool by_schedule = simulation_.state.steps > 0 && checkpoint_schedule_.due(simulation_.state.time);
    const bool by_wall = clock_.wall() - checkpoint_wall_ >= wall_interval_;
    return by_signal || by_schedule || by_wall;
}

void RunLoop::take_checkpoint()
{
    clock_.begin(RunPhase::output);
    const double begun = clock_.wall();
    WrittenFile metrics = metrics_->written();
    Archive archive;
    archive.take_room(std::move(recent_.bytes));
    archive(origin_);
    persist(archive, metrics);
    recent_ = {archive.take_bytes(), simulation_.state.time, clock_.wall(), clock_.wall() - begun};
}

/// Writes the one that was taken last.
void RunLoop::write_checkpoint()
{
    clock_.begin(RunPhase::output);
    lock_.hold();
    metrics_->sync();
    talus::write_checkpoint(folder_, TALUS_VERSION, recent_.bytes);
    note_checkpoint(folder_, recent_.time);
    checkpoint_wall_ = clock_.wall();
    if (verbosity_ != Verbosity::verbose) return;
    progress_.finish();
    warn("checkpoint at t = {:.6g} s: {:.1f} MB\n", recent_.time, 1e-6 * static_cast<double>(recent_.bytes.size()));
}

/// The clock comes last: of the state it is all that differs from run to run.
void RunLoop::persist(Archive& archive, WrittenFile& metrics)
{
    archive(simulation_, frames_, metrics, statistics_, clock_);
}

void RunLoop::write_what_is_due(const StepReport& report)
{
    const double time = simulation_.state.time;
    if (standing_walls(simulation_.model, time) != standing_) write_walls();
    if (metrics_schedule_.due(time)) {
        sample_sensors(report);
        write_metrics(report);
    }
    if (contact_schedule_.due(time)) write_contacts();
    if (particle_schedule_.due(time)) {
        write_particles();
        progress_.frame_written(simulation_, report, clock_.wall());
    }
}

void RunLoop::write_the_rest(const StepReport& report)
{
    const std::int64_t steps = simulation_.state.steps;
    if (last_particles_ != steps) write_particles();
    if (steps == 0) return; // contacts and metrics speak of a step
    if (last_contacts_ != steps && !simulation_.incident_policy.stops(report)) write_contacts();
    if (last_metrics_ != steps) {
        if (!simulation_.incident_policy.stops(report)) sample_sensors(report);
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
        static_cast<double>(simulation_.outflow.count), static_cast<double>(report.contacts.count),
        static_cast<double>(report.solve.sweeps), report.solve.residual, report.contacts.worst_overlap / d,
        report.contacts.mean_overlap() / d, report.bodies.kinetic_energy, report.bodies.potential_energy,
        report.contacts.stored_energy};
    const ErrorLook& look = statistics_.looks().latest();
    for (const double error : {look.velocity_error, look.of_flow(), look.of_contacts(), look.force_error})
        row.push_back(error);
    if (simulation_.model.physics.attraction) row.push_back(report.contacts.attraction_energy);
    for (const std::size_t w : watched_walls_)
        row.push_back(look.wall_errors.empty() ? ErrorLook::unknown : look.wall_errors[w]);
    for (const auto& sensor : simulation_.sensors)
        for (const Measurement& m : sensor->latest()) row.push_back(m.value);
    lock_.hold();
    metrics_->add_row(row);
    last_metrics_ = state.steps;
}

void RunLoop::write_tables()
{
    lock_.hold();
    for (const auto& sensor : simulation_.sensors)
        if (const auto table = sensor->table()) write_table(folder_, sensor->name, *table);
}

void RunLoop::write_particles()
{
    lock_.hold();
    frames_.write_particles(simulation_);
    const ModelledPhysics& physics = simulation_.model.physics;
    if (physics.moving_walls || physics.pistons) frames_.write_moving_walls(simulation_.model, simulation_.state);
    last_particles_ = simulation_.state.steps;
}

void RunLoop::write_contacts()
{
    lock_.hold();
    frames_.write_contacts(simulation_);
    last_contacts_ = simulation_.state.steps;
}

void RunLoop::write_walls()
{
    lock_.hold();
    frames_.write_walls(simulation_.model, simulation_.state);
    standing_ = standing_walls(simulation_.model, simulation_.state.time);
}

} // namespace talus
