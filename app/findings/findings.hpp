// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/findings/force_profile.hpp"
#include "app/findings/quietness.hpp"
#include "app/loop/run_statistics.hpp"
#include "app/loop/schedule.hpp"
#include "core/simulation/simulation.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// Units in which findings are reported, so that they compare from scene to scene. Without gravity, what would be that
/// of gravity is taken from the speeds at the start.
struct StudyUnits {
    explicit StudyUnits(const Simulation& start);

    double diameter;     ///< mean d [m]
    double acceleration; ///< g [m/s²]
    double speed;        ///< √(g d) [m/s]
    double mass;         ///< of all spheres at the start [kg]
    double grain_energy; ///< m g d of the mean sphere [J]
};

/// Gathers what a study (postprocess/study.py) wants to know of a run, from its start on: every step is added; spheres
/// and contacts are looked at every so often only.
class Findings
{
public:
    /// @param interval between two looks [s]
    Findings(const Simulation& start, double interval);

    /// Takes in the step that the simulation has just made.
    void add(const StepReport& report, Simulation& simulation);

    /// All results so far, those of the scene's sensors last.
    std::vector<Measurement> results(const Simulation& simulation) const;

    /// Mean support by walls and through cuts (force_profile.hpp), by the weight of the spheres at the start.
    std::vector<double> profile() const;

    double contact_updates() const { return statistics_.contact_updates(); } ///< contacts × sweeps so far

private:
    StudyUnits units_;
    Vec3 up_;
    Schedule looks_;
    double began_; ///< [s]
    RunStatistics statistics_;
    std::int64_t steps_ = 0;
    LogHistogram overlaps_;       ///< at the looks [d]
    Vec3 momentum_;               ///< after the last step [kg m/s]
    double momentum_error_ = 0.0; ///< worst, in M g h
    Displacements displacements_;
    ForceProfile cuts_;
    std::vector<double> force_sum_; ///< over the looks [N]
    double support_squares_ = 0.0;  ///< squares summed over the looks [N²]
    double height_sum_ = 0.0, restless_sum_ = 0.0;
    std::int64_t looked_ = 0;

    void add_momentum(const StepReport& report, const Simulation& simulation);
    void look(const StepReport& report, Simulation& simulation);
};

} // namespace talus
