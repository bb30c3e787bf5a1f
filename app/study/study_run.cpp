// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/study_run.hpp"

#include "app/loop/open_scene.hpp"
#include "app/study/findings.hpp"
#include "app/study/saved_state.hpp"
#include "core/base/statistics.hpp"
#include "io/run/summary.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/build/checks.hpp"

#include <fmt/format.h>

#include <ctime>
#include <functional>

#include <sys/resource.h>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

/// How often the velocity error is taken: it is of one step, and differs from step to step.
constexpr int velocity_looks = 3;

/// Of this process [s].
double cpu_time()
{
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_memory()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

OpenedScene open_setting(const StudyFrame& frame, const std::vector<std::string>& overrides, std::int64_t seed)
{
    std::vector<std::string> all = frame.study.set;
    all.insert(all.end(), overrides.begin(), overrides.end());
    SceneFile file = read_scene(frame.scene, all);
    file.scene.seed = seed;
    file.scene.time.duration = frame.end;
    return build_opened(std::move(file), frame.scene.stem());
}

fs::path state_folder(const StudyFrame& frame, std::int64_t seed)
{
    return frame.folder / fmt::format("start_of_seed_{}", seed);
}

std::string told(const Simulation& simulation, const StepReport& report)
{
    return fmt::format("t = {:.6g} s: {}", simulation.state.time,
        describe(report.bodies.incidents.front(), names_of(simulation.model.walls)));
}

/// Makes steps until a time, and tells each to `observe`. Returns what went wrong.
/// @param cpu time of the steps, added to what it was [s]
/// @param longest that it may become
std::string run_and_observe(double time, Simulation& simulation, const std::function<void(const StepReport&)>& observe,
    double& cpu, double longest = infinity)
{
    double before = 0.0;
    const auto begin = [&] {
        before = cpu_time();
        return cpu <= longest;
    };
    const auto end = [&](const StepReport& report) {
        cpu += cpu_time() - before;
        if (!simulation.incident_policy.stops(report)) observe(report);
    };
    const StepReport last = run_until(simulation, time, {.before_step = begin, .after_step = end});
    if (simulation.incident_policy.stops(last)) return told(simulation, last);
    if (cpu > longest)
        return fmt::format("given up after {:.3g} s of CPU, at t = {:.4g} s", cpu, simulation.state.time);
    return "";
}

void ignore(const StepReport&) {}

/// Lets the setting settle, and measures it. Returns what went wrong.
std::string fill_row(StudyRow& row, const StudyFrame& frame, OpenedScene& opened)
{
    Simulation& simulation = opened.simulation;
    const double longest = frame.study.longest, from = frame.measured_from();
    double settling_cpu = 0.0, cpu = 0.0;
    std::string failure = run_and_observe(from, simulation, ignore, settling_cpu, longest);
    if (!failure.empty()) return failure;

    Findings findings(simulation, opened.scene.time.metrics_interval);
    const double began = simulation.state.time, unit = StudyUnits(simulation).speed;
    const auto observe = [&](const StepReport& report) { findings.add(report, simulation); };
    MeanAndError velocity_error;
    for (int part = 1; part <= velocity_looks && failure.empty(); ++part) {
        velocity_error.add(velocity_error_of_next_step(simulation) / unit);
        failure = run_and_observe(from + part * (frame.end - from) / velocity_looks, simulation, observe, cpu, longest);
    }
    const double simulated = simulation.state.time - began;
    row.cpu = cpu / simulated;
    row.updates = findings.contact_updates() / simulated;
    row.findings.push_back({"velocity_error", velocity_error.mean(), velocity_error.standard_error(), "sqrt(g d)"});
    for (const Measurement& m : findings.results(simulation)) row.findings.push_back(m);
    row.profile = findings.profile();
    return failure;
}

} // namespace

std::string make_start(const StudyFrame& frame, std::int64_t seed)
{
    try {
        OpenedScene opened = open_setting(frame, {}, seed);
        double cpu = 0.0;
        const std::string failure = run_and_observe(frame.start, opened.simulation, ignore, cpu);
        if (!failure.empty()) return failure;
        save_state(opened.simulation, state_folder(frame, seed));
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

bool has_start(const StudyFrame& frame, std::int64_t seed)
{
    return fs::exists(state_folder(frame, seed) / "checkpoint.latest");
}

StudyRow run_setting(const StudyFrame& frame, const Setting& setting, std::int64_t seed)
{
    StudyRow row;
    row.setting = setting.name;
    row.seed = seed;
    try {
        OpenedScene opened = open_setting(frame, setting.overrides, seed);
        load_state(opened.simulation, state_folder(frame, seed));
        if (const std::string failure = fill_row(row, frame, opened); !failure.empty()) row.status = failure;
    } catch (const std::exception& error) {
        row.status = error.what();
    }
    row.memory = peak_memory();
    return row;
}

} // namespace talus
