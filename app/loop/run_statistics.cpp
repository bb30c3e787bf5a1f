// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/run_statistics.hpp"

#include <algorithm>

namespace talus
{

void RunStatistics::add(const StepReport& report, const Simulation& simulation)
{
    residuals_.add(report.solve.residual);
    if (!report.solve.converged) ++steps_at_cap_;
    if (report.sub_steps > 1) ++split_steps_;
    most_sub_steps_ = std::max(most_sub_steps_, report.sub_steps);

    overlap_sum_ += report.contacts.mean_overlap() * static_cast<double>(report.contacts.overlapping);
    overlap_count_ += static_cast<double>(report.contacts.overlapping);
    if (report.contacts.worst_overlap > worst_overlap_) {
        worst_overlap_ = report.contacts.worst_overlap;
        worst_overlap_time_ = simulation.state.time;
    }
    long_moves_ += static_cast<std::int64_t>(report.bodies.long_moves);
    cone_violation_ = std::max(cone_violation_, report.outcome.cone_violation);
    contact_updates_ += static_cast<double>(report.contacts.count) * report.solve.sweeps;

    const std::int64_t inserted = simulation.state.next_id;
    const std::int64_t left = simulation.outflow.count + static_cast<std::int64_t>(simulation.escaped.size());
    same_spheres_ = inserted == inserted_ && left == left_;
    energy_.add(report, same_spheres_);
    inserted_ = inserted;
    left_ = left;
}

ErrorSummary RunStatistics::error(const Model& model) const
{
    ErrorSummary error;
    error.tolerance = model.solver.tolerance;
    error.steps_at_cap = steps_at_cap_;
    error.split_steps = split_steps_;
    error.most_sub_steps = most_sub_steps_;
    error.mean_overlap = overlap_count_ > 0.0 ? overlap_sum_ / overlap_count_ / model.mean_diameter : 0.0;
    error.worst_overlap = worst_overlap_ / model.mean_diameter;
    error.worst_overlap_time = worst_overlap_time_;
    error.long_moves = long_moves_;
    error.cone_violation = cone_violation_;
    error.energy_lost = energy_.lost();
    error.energy_gained = energy_.gained();
    error.energy_put_in = energy_.put_in();
    error.mean_residual = residuals_.mean();
    error.residual_95 = residuals_.percentile(0.95);
    error.worst_residual = residuals_.worst();
    return error;
}

} // namespace talus
