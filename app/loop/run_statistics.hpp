// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/energy_balance.hpp"
#include "app/loop/log_histogram.hpp"
#include "io/run/summary.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// Gathers the reports of all steps into what the run says about its own error.
class RunStatistics
{
public:
    /// Takes in the report of the step that the simulation has just made.
    void add(const StepReport& report, const Simulation& simulation);

    ErrorSummary error(const Model& model) const;

    double contact_updates() const { return contact_updates_; } ///< contacts × sweeps

    /// Whether the last step had the spheres of the step before it.
    bool same_spheres() const { return same_spheres_; }

    void persist(Archive& archive)
    {
        archive(residuals_, steps_at_cap_, overlap_sum_, overlap_count_, worst_overlap_, worst_overlap_time_,
            long_moves_, split_steps_, most_sub_steps_, cone_violation_, contact_updates_, energy_, inserted_, left_);
    }

private:
    LogHistogram residuals_;
    std::int64_t steps_at_cap_ = 0;
    double overlap_sum_ = 0.0, overlap_count_ = 0.0; ///< over all overlapping contacts of all steps
    double worst_overlap_ = 0.0, worst_overlap_time_ = 0.0;
    std::int64_t long_moves_ = 0;
    std::int64_t split_steps_ = 0;
    int most_sub_steps_ = 1;
    double cone_violation_ = 0.0;
    double contact_updates_ = 0.0;
    EnergyBalance energy_;
    std::int64_t inserted_ = 0, left_ = 0; ///< up to the last step, also by escape
    bool same_spheres_ = false;
};

} // namespace talus
