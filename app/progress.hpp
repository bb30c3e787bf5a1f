// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"
#include "core/time_step.hpp"
#include "scenarios/simulation.hpp"

#include <string>

namespace talus
{

/// Tells on standard error how far a run is: on a terminal a line that is written over, elsewhere a line now and then.
class Progress
{
public:
    Progress(Verbosity verbosity, double duration);

    /// Shows the step just made if it is time for that.
    /// @param wall time since the run began [s]
    void update(const Simulation& simulation, const StepReport& report, double wall);

    /// A line for a frame just written, if the user wants to hear of it.
    void frame_written(const Simulation& simulation, const StepReport& report, double wall);

    /// Leaves the terminal's line, so that other text can follow.
    void finish();

private:
    std::string line(const Simulation& simulation, const StepReport& report, double wall) const;

    Verbosity verbosity_;
    bool terminal_;
    double duration_;
    double interval_;   ///< between lines, in wall time [s]
    double next_ = 0.0; ///< wall time of the next line [s]
    bool line_open_ = false;
};

} // namespace talus
