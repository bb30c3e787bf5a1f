// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/run_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{

void LogHistogram::add(double value)
{
    // bin k > 0 holds those up to 10^(least_exponent + k / bins_per_decade)
    const double bins_up = value > 0.0 ? std::ceil(bins_per_decade * (std::log10(value) - least_exponent)) : 0.0;
    const double bin = std::clamp(bins_up, 0.0, static_cast<double>(counts_.size() - 1));
    ++counts_[static_cast<std::size_t>(bin)];
    ++count_;
    sum_ += value;
    worst_ = std::max(worst_, value);
}

double LogHistogram::mean() const
{
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
}

double LogHistogram::percentile(double share) const
{
    const double wanted = share * static_cast<double>(count_);
    std::int64_t reached = 0;
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
        reached += counts_[bin];
        if (static_cast<double>(reached) < wanted) continue;
        const double edge = std::pow(10.0, least_exponent + static_cast<double>(bin) / bins_per_decade);
        return std::min(edge, worst_);
    }
    return worst_;
}

void EnergyBalance::add(const StepReport& report, bool comparable)
{
    if (!comparable) motion_energy_ = total_energy_ = std::nullopt;

    // a report has the contact energy at the beginning of its step, which is the end of the step before
    std::optional<double> total;
    if (motion_energy_) total = *motion_energy_ + report.contacts.stored_energy;
    if (total && total_energy_) {
        const double rise = *total - *total_energy_ - work_ - attraction_work_;
        lost_ += std::max(0.0, -rise);
        gained_ += std::max(0.0, rise);
    }
    if (total) *total += report.exchange.energy;
    total_energy_ = total;
    work_ = report.outcome.wall_work + report.bodies.load_work + report.bodies.gravity_work;
    put_in_ += work_;
    attraction_work_ = report.attraction_work;
    motion_energy_ = report.bodies.kinetic_energy + report.bodies.potential_energy;
}

void MomentumBalance::add(const StepReport& report, bool same_spheres)
{
    const StateSurvey& bodies = report.bodies;
    WallLoad walls = report.outcome.from_walls;
    walls += report.outcome.from_pistons;
    if (same_spheres) {
        left_over_[0] += (bodies.momentum.linear - last_.linear - bodies.from_gravity.linear - walls.impulse).norm();
        left_over_[1] += (bodies.momentum.angular - last_.angular - bodies.from_gravity.angular - walls.torque).norm();
        from_gravity_ += bodies.from_gravity;
        from_walls_ += Momentum{walls.impulse, walls.torque};
    }
    last_ = bodies.momentum;
}

void RunStatistics::add(const StepReport& report, const Simulation& simulation)
{
    residuals_.add(report.solve.residual);
    if (!report.solve.converged) ++sums_.steps_at_cap;
    if (report.sub_steps > 1) ++sums_.split_steps;
    if (report.sub_steps > sums_.most_sub_steps) {
        sums_.most_sub_steps = report.sub_steps;
        sums_.split_for = report.split_for;
    }
    sums_.cone_violation = std::max(sums_.cone_violation, report.outcome.cone_violation);
    sums_.corrections += report.scaling.corrections;
    sums_.refused_corrections += report.scaling.refused;

    overlap_sum_ += report.contacts.mean_overlap() * static_cast<double>(report.contacts.overlapping);
    overlap_count_ += static_cast<double>(report.contacts.overlapping);
    const double worst_overlap = report.contacts.worst_overlap / simulation.model.mean_diameter;
    if (worst_overlap > sums_.worst_overlap) {
        sums_.worst_overlap = worst_overlap;
        sums_.worst_overlap_time = simulation.state.time;
    }
    contact_updates_ += static_cast<double>(report.contacts.count) * report.solve.sweeps;

    const std::int64_t inserted = simulation.state.next_id;
    const std::int64_t left = simulation.outflow.count + static_cast<std::int64_t>(simulation.escaped.size()) +
                              simulation.interventions.taken_out;
    same_spheres_ = inserted == inserted_ && left == left_;
    const Exchange& exchange = report.exchange;
    energy_.add(report, inserted - inserted_ == exchange.came && left - left_ == exchange.left);
    momentum_.add(report, same_spheres_);
    inserted_ = inserted;
    left_ = left;
}

ErrorSummary RunStatistics::error(const Model& model) const
{
    ErrorSummary error = sums_;
    error.tolerance = model.solver.tolerance;
    error.mean_residual = residuals_.mean();
    error.residual_95 = residuals_.percentile(0.95);
    error.worst_residual = residuals_.worst();
    error.mean_overlap = overlap_count_ > 0.0 ? overlap_sum_ / overlap_count_ / model.mean_diameter : 0.0;
    error.energy_lost = energy_.lost();
    error.energy_gained = energy_.gained();
    error.energy_put_in = energy_.put_in();
    error.linear = momentum_.linear();
    if (!model.periodicity.any()) error.angular = momentum_.angular();
    return error;
}

} // namespace talus
