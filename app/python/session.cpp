// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/python/session.hpp"

#include "app/loop/run_report.hpp"
#include "app/system/threads.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/summary.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/checks.hpp"

#include <pybind11/pybind11.h>

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numeric>

namespace talus::python
{
namespace
{

namespace fs = std::filesystem;
namespace py = pybind11;

/// Asks Python now and then whether Ctrl-C was pressed: not after every step, for other threads may hold its lock.
class CtrlC
{
public:
    /// Whether to go on; else Python's error is set.
    bool operator()()
    {
        using namespace std::chrono_literals;
        const auto now = std::chrono::steady_clock::now();
        if (now < next_) return true;
        next_ = now + 50ms;
        const py::gil_scoped_acquire lock;
        return PyErr_CheckSignals() == 0;
    }

private:
    std::chrono::steady_clock::time_point next_ = {};
};

/// True while it lives.
class Raised
{
public:
    explicit Raised(std::atomic<bool>& flag) : flag_(flag) { flag_ = true; }
    ~Raised() { flag_ = false; }
    Raised(const Raised&) = delete;
    Raised& operator=(const Raised&) = delete;

private:
    std::atomic<bool>& flag_;
};

/// Of this process [s].
double cpu_time()
{
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Before any simulation asked for a number of its own.
int usual_threads()
{
    static const int threads = omp_get_max_threads();
    return threads;
}

int threads_or_usual(int threads)
{
    if (threads < 0 || threads > most_threads)
        throw std::invalid_argument(fmt::format("threads is {}: give 1 to {}, or 0 for all", threads, most_threads));
    return threads > 0 ? threads : usual_threads();
}

std::shared_ptr<Session> open_again(SceneFile file, const RunOrigin& origin, int threads)
{
    refuse_other_scene(file, origin);
    return std::make_shared<Session>(build_opened(std::move(file), origin.scene_name), threads);
}

} // namespace

Session::Session(OpenedScene opened, int threads)
    : opened_(std::move(opened)), origin_(origin_of(opened_.name, opened_.scene)), threads_(threads_or_usual(threads)),
      samples_(opened_.scene.time.metrics_interval), warnings_(opened_.report.warnings)
{
    opened_.simulation.model.physics.wall_loads = true; // wall().force has them, whatever sensors ask for
}

void Session::write_into(const fs::path& folder, bool force)
{
    const auto files = named_files(opened_.scene);
    lock_ = std::make_unique<FolderLock>(
        make_run_folder(folder, resolved_scene(with_copies(opened_.scene, files)), force, inputs_of(opened_, files)));
    copy_files(files, folder);
    loop_ = std::make_unique<RunLoop>(opened_, *lock_, Verbosity::quiet);
}

std::shared_ptr<Session> Session::resume(const fs::path& place, const std::vector<std::string>& overrides, int threads)
{
    const bool is_folder = fs::is_directory(place);
    auto lock = is_folder ? std::make_unique<FolderLock>(place) : nullptr;
    Checkpoint checkpoint =
        is_folder ? read_checkpoint(place, TALUS_VERSION) : read_checkpoint_file(place, TALUS_VERSION);
    try {
        Archive archive(std::move(checkpoint.state));
        RunOrigin origin;
        archive(origin);
        const fs::path scene = is_folder ? place / "scene.resolved.toml" : place;
        auto session =
            open_again(is_folder ? read_scene(scene, overrides) : read_scene_text(origin.scene, scene, overrides),
                origin, threads);
        if (!is_folder) {
            session->put_back(archive);
            return session;
        }
        OpenedScene& opened = session->opened_;
        session->lock_ = std::move(lock);
        session->loop_ = std::make_unique<RunLoop>(opened, *session->lock_, Verbosity::quiet, archive);
        write_atomically(scene, resolved_scene(with_copies(opened.scene, named_files(opened.scene))));
        fs::remove(place / "summary.json"); // of a run that had ended; this one has not
        return session;
    } catch (const ArchiveError& error) {
        throw InputError(fmt::format(
            "{}: cannot be put back, as by another build of Talus: {}", checkpoint.path.string(), error.what()));
    }
}

void Session::run_until(double time)
{
    Simulation& simulation = change();
    if (loop_ && time > simulation.duration + 0.5 * simulation.model.time_step)
        throw std::invalid_argument(fmt::format("a run in a folder ends at its time.duration, {:.6g} s, and not at "
                                                "{:.6g} s; set={{'time.duration': …}} changes that",
            simulation.duration, time));
    if (loop_)
        make_steps([&] { loop_->run_until(std::min(time, simulation.duration), CtrlC()); });
    else
        make_steps([&] {
            StepHooks hooks;
            hooks.before_step = CtrlC();
            hooks.after_step = [this](const StepReport& report) { after_step(report); };
            hooks.on_phase = [this](Phase phase) { clock_.begin(phase); };
            last_ = talus::run_until(simulation, time, hooks, std::move(last_));
        });
}

double Session::run_observed(
    double time, double spent, double longest, const std::function<void(const StepReport&, Simulation&)>& observe)
{
    Simulation& simulation = change();
    if (loop_) throw std::invalid_argument("a run in a folder is observed by what it writes there");
    make_steps([&] {
        double before = 0.0;
        StepHooks hooks;
        hooks.before_step = [&, go_on = CtrlC()]() mutable {
            const bool goes_on = spent <= longest && go_on();
            before = cpu_time();
            return goes_on;
        };
        hooks.after_step = [&](const StepReport& report) {
            spent += cpu_time() - before;
            if (!simulation.incident_policy.stops(report)) observe(report, simulation);
        };
        last_ = talus::run_until(simulation, time, hooks, std::move(last_));
    });
    return spent;
}

void Session::make_steps(const std::function<void()>& make)
{
    {
        const Raised flag(stepping_);
        const py::gil_scoped_release free;
        omp_set_num_threads(threads_);
        make();
    }
    if (PyErr_Occurred()) throw py::error_already_set();
    const Simulation& simulation = opened_.simulation;
    if (!simulation.incident_policy.stops(report())) return;
    const auto names = names_of(simulation.model.walls);
    const auto& incidents = report().bodies.incidents;
    throw Stopped{fmt::format("t = {:.6g} s: {}", simulation.state.time, describe(incidents.front(), names)),
        incidents_text(incidents, names)};
}

void Session::after_step(const StepReport& report)
{
    Simulation& simulation = opened_.simulation;
    clock_.begin(RunPhase::sensors);
    statistics_.add(report, simulation);
    if (const std::string warning = watch_.warning_after(report, simulation); !warning.empty())
        warnings_.push_back(warning);
    if (simulation.incident_policy.stops(report)) return;
    show_to_sensors(simulation, report, samples_.due(simulation.state.time));
    clock_.begin(RunPhase::output);
}

/// As a RunLoop stores itself: with the frames of its four series and the size of metrics.csv, which there are none of.
void Session::persist(Archive& archive)
{
    std::array<std::vector<double>, 4> frames;
    WrittenFile metrics;
    archive(opened_.simulation, frames[0], frames[1], frames[2], frames[3], metrics, statistics_, clock_);
}

void Session::put_back(Archive& archive)
{
    persist(archive);
    if (!archive.at_end()) throw ArchiveError("the saved state is longer than what this scene needs");
    if (opened_.simulation.state.steps > 0) samples_.due(opened_.simulation.state.time);
}

void Session::save(const fs::path& file)
{
    if (is_of_others(file, checkpoint_mark))
        throw OutputError(file.string() + ": is no checkpoint, and is not overwritten");
    Simulation& simulation = now();
    remove_escaped(simulation.escaped, simulation.state, simulation.network, report().bodies.incidents);
    RunOrigin origin = origin_;
    origin.scene = resolved_scene(opened_.scene); // with the files where they are: no copies come with it
    Archive archive;
    archive(origin);
    if (loop_) statistics_ = loop_->statistics(), clock_ = loop_->clock();
    persist(archive);
    write_checkpoint_file(file, TALUS_VERSION, archive.bytes());
}

std::string Session::state()
{
    Archive archive;
    archive(origin_);
    now().persist_without_sensors(archive);
    return checkpoint_bytes(TALUS_VERSION, archive.bytes());
}

void Session::restore(const std::string& state)
{
    Archive archive(state_in(state, TALUS_VERSION));
    RunOrigin origin;
    archive(origin);
    refuse_other_state(origin_, origin);
    Simulation& simulation = change();
    simulation.persist_without_sensors(archive);
    const double h = simulation.model.time_step;
    simulation.state.steps = std::llround(simulation.state.time / h);
    simulation.state.time = static_cast<double>(simulation.state.steps) * h;
    simulation.interventions.any = true;
}

void Session::close()
{
    if (!loop_) return;
    change();
    const RunEnd end = loop_->end();
    lock_->hold();
    write_summary(
        lock_->folder() / "summary.json", summarise(opened_, loop_->statistics(), loop_->clock(), end.incidents));
    last_ = loop_->last();
    statistics_ = loop_->statistics();
    clock_ = loop_->clock();
    samples_.due(opened_.simulation.state.time);
    loop_.reset();
    lock_.reset();
}

std::string Session::summary() const
{
    const auto& incidents = report().bodies.incidents;
    const bool failed = opened_.simulation.incident_policy.stops(report());
    return summary_text(summarise(opened_, loop_ ? loop_->statistics() : statistics_, loop_ ? loop_->clock() : clock_,
        failed ? incidents : std::vector<Incident>{}));
}

Simulation& Session::now()
{
    if (stepping_) throw Busy("another thread makes steps of this simulation");
    return opened_.simulation;
}

Simulation& Session::change()
{
    Simulation& simulation = now();
    if (lease_.use_count() > 1) { // they keep what they see
        State& state = simulation.state;
        *lease_ = {state.position, state.bodies, state.radius, state.id, state.material};
        std::swap(lease_->position, state.position);
        std::swap(lease_->bodies, state.bodies);
        std::swap(lease_->radius, state.radius);
        std::swap(lease_->id, state.id);
        std::swap(lease_->material, state.material);
    }
    lease_.reset();
    ++generation_;
    return simulation;
}

const std::shared_ptr<Lease>& Session::lease()
{
    now();
    if (!lease_) lease_ = std::make_shared<Lease>();
    return lease_;
}

const std::vector<std::size_t>& Session::order()
{
    const State& state = now().state;
    if (order_generation_ == generation_) return order_;
    order_.resize(state.count());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::sort(order_, {}, [&](std::size_t i) { return state.id[i]; });
    order_generation_ = generation_;
    return order_;
}

std::size_t Session::index_of(std::int64_t id)
{
    const auto& sorted = order();
    const auto found = std::ranges::lower_bound(sorted, id, {}, [&](std::size_t i) { return now().state.id[i]; });
    if (found == sorted.end() || now().state.id[*found] != id)
        throw std::out_of_range(fmt::format("there is no sphere {}", id));
    return *found;
}

std::vector<std::string> Session::take_warnings()
{
    return std::exchange(warnings_, {});
}

} // namespace talus::python
