// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/system/terminal.hpp"
#include "core/step/time_step.hpp"
#include "scenarios/simulation.hpp"

#include <string>

namespace talus
{

/// Tells on standard error how far a run is: on a terminal a line that is written over, elsewhere a line now and then.
class Progress
{
public:
    /// @param simulation as it begins, or as it is resumed
    Progress(Verbosity verbosity, const Simulation& simulation);

    /// Shows the step just made if it is time for that.
    /// @param wall time since the run began or was resumed [s]
    void update(const Simulation& simulation, const StepReport& report, double wall);

    /// A line for a frame just written, if the user wants to hear of it.
    void frame_written(const Simulation& simulation, const StepReport& report, double wall);

    /// Leaves the terminal's line, so that other text can follow.
    void finish();

private:
    std::string line(const Simulation& simulation, const StepReport& report, double wall) const;

    Verbosity verbosity_;
    bool terminal_;
    double duration_, start_; ///< simulated [s]
    std::int64_t first_step_;
    double interval_;          ///< between lines, in wall time [s]
    double next_;              ///< wall time of the next line [s]
    double next_logged_ = 0.0; ///< likewise, in a log file beside a terminal
    bool line_open_ = false;
};

} // namespace talus
