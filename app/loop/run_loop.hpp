// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"
#include "app/loop/progress.hpp"
#include "app/loop/run_origin.hpp"
#include "app/loop/run_statistics.hpp"
#include "app/loop/schedule.hpp"
#include "app/system/phase_clock.hpp"
#include "core/simulation/simulation.hpp"
#include "io/run/frames.hpp"
#include "io/run/run_files.hpp"
#include "scenarios/scene.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace talus
{

/// How a run ended: at its time, by an incident, or by a signal.
struct RunEnd {
    std::vector<Incident> incidents; ///< none where all went well
    int signal = 0;                  ///< that stopped it before its end, after a checkpoint; 0: none
};

/// Steps a simulation to its end and writes what its scene asks for on the way.
///
/// Frames and rows of metrics.csv are written at the first step at or after their due time. The first frames show the
/// start and the last ones the end, be it the scene's or the step of an incident. The last checkpoint is that before
/// the last step: from there a run can be closed anew or go on, without the frames that are there only because it
/// ended. Where a step fails it is one of about a second of the clock before.
class RunLoop
{
public:
    /// A run from its beginning.
    /// @param lock on the output folder
    /// @throws OutputError
    RunLoop(OpenedScene& opened, FolderLock& lock, Verbosity verbosity);

    /// A run from its checkpoint, which is put back into the simulation; what was written after it is taken away.
    /// @param checkpoint what a RunLoop stored
    /// @throws ArchiveError, InputError before anything is changed in the folder; OutputError
    RunLoop(OpenedScene& opened, FolderLock& lock, Verbosity verbosity, Archive& checkpoint);

    /// Runs to the end, to the first step with incidents that stop it, or until a signal asks it to stop.
    /// @throws OutputError
    RunEnd run();

    // The same in parts, for who does something of his own between steps:

    /// Runs to this time [s], or as long as `go_on`, asked before each step, wants.
    /// @throws OutputError
    void run_until(double time, const std::function<bool()>& go_on = {});

    /// Ends the run where it is: before its time with a checkpoint, as a signal would.
    /// @throws OutputError
    RunEnd end();

    /// From now on the run has companions, and looks closer at the error of its solver.
    void estimate_error();

    const StepReport& last() const { return last_; } ///< report of the last step; where none was made, an empty one

    const RunStatistics& statistics() const { return statistics_; }
    const PhaseClock& clock() const { return clock_; }

private:
    RunLoop(OpenedScene& opened, FolderLock& lock, Verbosity verbosity, Archive* checkpoint);
    void begin();
    void go_on(Archive& checkpoint);

    void before_step(bool is_last);
    void after_step(const StepReport& report);
    void write_what_is_due(const StepReport& report);
    void write_the_rest(const StepReport& report);
    void look_at_error(const StepReport& report);
    void tell_incidents(const StepReport& report);

    bool checkpoint_is_due();
    void take_checkpoint();
    void write_checkpoint();
    void persist(Archive& archive, WrittenFile& metrics);

    void sample_sensors(const StepReport& report);
    void write_metrics(const StepReport& report);
    void write_tables();
    void write_particles();
    void write_contacts();
    void write_walls();

    const scene::Scene& scene_;
    Simulation& simulation_;
    FolderLock& lock_;
    std::filesystem::path folder_;
    RunOrigin origin_;
    double wall_interval_; ///< between checkpoints [s]
    Verbosity verbosity_;
    Schedule metrics_schedule_, particle_schedule_, contact_schedule_, checkpoint_schedule_;
    /// A checkpoint, which is written every now and then, and where a step fails.
    struct {
        std::string bytes;
        double time = 0.0;        ///< of the state [s]
        double taken = -infinity; ///< when, by the clock [s]
        double pains = 0.0;       ///< how long that took [s]
    } recent_;
    double checkpoint_wall_ = 0.0;                                              ///< when the last was written [s]
    std::int64_t last_metrics_ = -1, last_particles_ = -1, last_contacts_ = -1; ///< steps after which they were written
    std::vector<std::size_t> watched_walls_;                                    ///< by a sensor of their force
    std::vector<std::pair<bool, bool>> standing_;                               ///< walls in the last wall frame
    FrameWriter frames_;
    std::optional<MetricsFile> metrics_; ///< there as soon as the loop is made
    std::size_t lost_ = 0;               ///< spheres in lost.vtp
    std::size_t presses_told_ = 0;
    StepReport last_;
    int signal_ = 0; ///< that asked the run to stop
    RunStatistics statistics_;
    PhaseClock clock_;
    Progress progress_;
};

} // namespace talus
