// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/phase_clock.hpp"
#include "app/progress.hpp"
#include "app/run_statistics.hpp"
#include "app/schedule.hpp"
#include "io/frames.hpp"
#include "io/run_files.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

#include <filesystem>
#include <vector>

namespace talus
{

/// Steps a simulation to its end and writes what its scene asks for on the way.
///
/// Frames and rows of metrics.csv are written at the first step at or after their due time. The first frames show the
/// start and the last ones the end, be it the scene's or the step of an incident.
class RunLoop
{
public:
    /// @param folder the output folder, which exists
    RunLoop(Simulation& simulation, const scene::Scene& scene, const std::filesystem::path& folder, Progress& progress);

    /// Runs to the end, or to the first step with incidents.
    /// @returns the incidents: none where all went well
    /// @throws OutputError
    std::vector<Incident> run();

    const RunStatistics& statistics() const { return statistics_; }
    const PhaseClock& clock() const { return clock_; }

private:
    StepReport make_step();
    void write_what_is_due(const StepReport& report);
    void write_the_rest(const StepReport& report);

    void sample_sensors(const StepReport& report);
    void write_metrics(const StepReport& report);
    void write_tables();
    void write_particles();
    void write_contacts();
    void write_walls();

    Simulation& simulation_;
    std::filesystem::path folder_;
    Progress& progress_;
    FrameWriter frames_;
    MetricsFile metrics_;
    Schedule metrics_schedule_, particle_schedule_, contact_schedule_;
    std::int64_t last_metrics_ = -1, last_particles_ = -1, last_contacts_ = -1; ///< steps after which they were written
    std::vector<bool> standing_;                                                ///< walls in the last wall frame
    RunStatistics statistics_;
    PhaseClock clock_;
};

} // namespace talus
