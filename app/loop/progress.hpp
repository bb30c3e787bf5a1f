// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/system/terminal.hpp"
#include "core/simulation/simulation.hpp"
#include "core/step/time_step.hpp"

#include <cstdint>
#include <string>

namespace talus
{

/// Watches whether the time step is small enough for what happens, and says once which would be.
class StepWatch
{
public:
    /// Takes in the report of a step that the simulation has just made. @returns a warning, or nothing
    std::string warning_after(const StepReport& report, const Simulation& simulation);

private:
    int split_steps_ = 0;
    Approach fastest_;     ///< in those
    int deep_steps_ = 0;   ///< in a row with deep overlap
    double deepest_ = 0.0; ///< in those [m]
    bool split_told_ = false, overlap_told_ = false;

    std::string warning_of_splits(const StepReport& report, const Model& model);
    std::string warning_of_overlap(const StepReport& report, const Simulation& simulation);
};

/// Tells on standard error how far a run is: on a terminal a line that is written over, elsewhere a line now and then;
/// and what its steps are to be warned of.
class Progress
{
public:
    /// @param simulation as it begins, or as it is resumed
    Progress(Verbosity verbosity, const Simulation& simulation);

    /// Warns of the step just made where there is need, and shows it if it is time for that.
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
    double next_logged_ = 0.0; ///< wall time of the next line in a log file beside a terminal [s]
    bool line_open_ = false;
    StepWatch watch_;
};

} // namespace talus
