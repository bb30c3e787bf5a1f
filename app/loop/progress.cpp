// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/progress.hpp"

#include "app/system/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

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

} // namespace

Progress::Progress(Verbosity verbosity, const Simulation& simulation)
    : verbosity_(verbosity), terminal_(isatty(STDERR_FILENO) == 1), duration_(simulation.duration),
      start_(simulation.state.time), first_step_(simulation.state.steps),
      interval_(terminal_ ? terminal_interval : log_interval), next_(interval_)
{
}

void Progress::update(const Simulation& simulation, const StepReport& report, double wall)
{
    if (verbosity_ == Verbosity::quiet || wall < next_) return;
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
        static_cast<double>(state.steps - first_step_) / wall, state.count(), report.contacts.count, report.solve.residual,
        100.0 * report.contacts.worst_overlap / simulation.model.mean_diameter);
}

} // namespace talus
