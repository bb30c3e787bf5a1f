// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/progress.hpp"

#include "core/contacts/loads.hpp"
#include "io/run/summary.hpp"
#include "scenarios/builder/checks.hpp"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr double terminal_interval = 0.2;
constexpr double log_interval = 10.0;

/// Minutes and seconds, with hours where there are some.
std::string clock_time(double seconds)
{
    const auto s = static_cast<long>(seconds + 0.5);
    if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// A line that wraps could not be written over.
std::string cut_to_terminal(const std::string& text)
{
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return text.substr(0, known ? size.ws_col - 1 : 79);
}

constexpr int many_splits = 10;          ///< a few fast grains now and then do no harm
constexpr double unsplit_approach = 0.1; ///< smallest diameters
constexpr double deep_overlap = 0.05;    ///< diameters
constexpr double wanted_overlap = 0.02;  ///< diameters
constexpr int deep_overlap_steps = 200;  ///< an impact's overlap is over sooner

/// Rounded down to two digits.
double round_down(double value)
{
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return std::floor(value / unit) * unit;
}

/// ", now sphere 3 and the wall 'lid' most": the bodies of the deepest contact.
std::string deepest_now(const Simulation& simulation)
{
    const State& state = simulation.state;
    double deepest = 0.0;
    std::string who;
    for_each_loaded_sphere_contact(simulation.network, [&](const Contact& c) {
        if (-c.gap <= deepest) return;
        deepest = -c.gap;
        who = name_spheres(state.id[c.a], state.id[c.b]);
    });
    for_each_loaded_wall_contact(simulation.network, [&](const Contact& c) {
        if (-c.gap <= deepest) return;
        deepest = -c.gap;
        who = name_sphere_and_wall(state.id[c.a], simulation.model.walls[c.b].name);
    });
    return who.empty() ? "" : fmt::format(", now {} most", who);
}

} // namespace

std::string StepWatch::warning_after(const StepReport& report, const Simulation& simulation)
{
    const std::string of_splits = warning_of_splits(report, simulation.model);
    return of_splits.empty() ? warning_of_overlap(report, simulation) : of_splits;
}

std::string StepWatch::warning_of_splits(const StepReport& report, const Model& model)
{
    if (split_told_ || report.sub_steps == 1) return "";
    if (report.split_for.speed > fastest_.speed) fastest_ = report.split_for;
    if (++split_steps_ < many_splits) return "";
    split_told_ = true;
    return fmt::format("{} steps have been split so far, for {}; all could be as long: --set time.step={:.2g}",
        split_steps_, describe(fastest_, names_of(model.walls)),
        round_down(unsplit_approach * model.min_diameter / fastest_.speed));
}

std::string StepWatch::warning_of_overlap(const StepReport& report, const Simulation& simulation)
{
    if (overlap_told_) return "";
    const Model& model = simulation.model;
    if (report.contacts.worst_overlap < deep_overlap * model.mean_diameter) {
        deep_steps_ = 0;
        deepest_ = 0.0;
        return "";
    }
    deepest_ = std::max(deepest_, report.contacts.worst_overlap);
    if (++deep_steps_ < deep_overlap_steps) return "";
    overlap_told_ = true;
    // the stiffness that the sweeps can carry goes with 1/h²
    const double overlap = deepest_ / model.mean_diameter;
    return fmt::format("spheres have overlapped by up to {:.2g} % d for {} steps{}; contacts are stiffer with shorter "
                       "ones: --set time.step={:.2g}",
        100.0 * overlap, deep_steps_, deepest_now(simulation),
        round_down(model.time_step * std::sqrt(wanted_overlap / overlap)));
}

Progress::Progress(Verbosity verbosity, const Simulation& simulation)
    : verbosity_(verbosity), terminal_(isatty(STDERR_FILENO) == 1), duration_(simulation.duration),
      start_(simulation.state.time), first_step_(simulation.state.steps),
      interval_(terminal_ ? terminal_interval : log_interval), next_(interval_)
{
}

void Progress::update(const Simulation& simulation, const StepReport& report, double wall)
{
    if (verbosity_ == Verbosity::quiet) return;
    if (const std::string warning = watch_.warning_after(report, simulation); !warning.empty()) {
        finish();
        warn("t = {:.6g} s: {}\n", simulation.state.time, warning);
    }
    if (wall < next_) return;
    next_ = wall + interval_;
    const std::string text = line(simulation, report, wall);
    if (!terminal_) return warn("{}\n", text);
    fmt::print(stderr, "\r{}\x1b[K", cut_to_terminal(text)); // clearing what a longer line leaves behind
    line_open_ = true;
    if (wall < next_logged_) return;
    next_logged_ = wall + log_interval;
    log_text(text);
}

void Progress::frame_written(const Simulation& simulation, const StepReport& report, double wall)
{
    if (verbosity_ != Verbosity::verbose) return;
    finish();
    warn("frame: {}\n", line(simulation, report, wall));
}

void Progress::finish()
{
    if (line_open_) fmt::print(stderr, "\n");
    line_open_ = false;
}

std::string Progress::line(const Simulation& simulation, const StepReport& report, double wall) const
{
    const State& state = simulation.state;
    const double share = duration_ > start_ ? std::min(1.0, (state.time - start_) / (duration_ - start_)) : 1.0;
    const double remaining = share > 0.0 ? wall * (1.0 - share) / share : 0.0;
    return fmt::format(
        "t {:.4g} s  {:.0f} %  ETA {}  step {}  {:.0f} steps/s  {} spheres  {} contacts  residual {:.1e}  "
        "overlap {:.2g} % d",
        state.time, 100.0 * state.time / duration_, clock_time(remaining), state.steps,
        static_cast<double>(state.steps - first_step_) / wall, state.count(), report.contacts.count,
        report.solve.residual, 100.0 * report.contacts.worst_overlap / simulation.model.mean_diameter);
}

} // namespace talus
