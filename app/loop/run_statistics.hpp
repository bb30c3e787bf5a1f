// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/companions.hpp"
#include "app/loop/error_looks.hpp"
#include "core/base/archive.hpp"
#include "core/simulation/simulation.hpp"
#include "io/run/summary.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace talus
{

/// How often a quantity from 0 up was how large: mean, percentiles and worst of any number of values in a fixed size.
class LogHistogram
{
public:
    void add(double value);

    double mean() const;
    double worst() const { return worst_; }

    /// What this share of the values does not exceed, at most 2.4 % too large; 0 where there are none.
    double percentile(double share) const;

    void persist(Archive& archive) { archive(counts_, count_, sum_, worst_); }

private:
    static constexpr int bins_per_decade = 100;
    static constexpr int least_exponent = -9;  ///< smaller values share the first bin
    static constexpr int largest_exponent = 3; ///< larger ones the last

    std::array<std::int64_t, bins_per_decade*(largest_exponent - least_exponent) + 1> counts_ = {};
    std::int64_t count_ = 0;
    double sum_ = 0.0, worst_ = 0.0;
};

/// Falls and rises of the total energy from step to step: kinetic + potential + stored in the contacts, less what
/// moving walls, loads on pistons, and gravity along periodic axes, put in, and pours and outlets carried in and out.
class EnergyBalance
{
public:
    /// @param comparable whether the spheres of the step before are there, but for what pours and outlets exchanged
    void add(const StepReport& report, bool comparable);

    double lost() const { return lost_; }     ///< sum of the falls [J]
    double gained() const { return gained_; } ///< sum of the rises [J]
    double put_in() const { return put_in_; } ///< work of moving walls, loads, and gravity along periodic axes [J]

    void persist(Archive& archive)
    {
        archive(lost_, gained_, put_in_, work_, attraction_work_, motion_energy_, total_energy_);
    }

private:
    double lost_ = 0.0, gained_ = 0.0, put_in_ = 0.0;
    double work_ = 0.0;                   ///< put in by the last step …
    double attraction_work_ = 0.0;        ///< … and by attraction, which is none of it
    std::optional<double> motion_energy_; ///< kinetic + potential at the end of the last step
    std::optional<double> total_energy_;  ///< at the end of the step before it
};

/// Where the spheres' momentum comes from: gravity, walls, and what nothing explains. Only steps with the same spheres
/// are looked at.
class MomentumBalance
{
public:
    /// @param same_spheres whether those in the step are those of the step before
    void add(const StepReport& report, bool same_spheres);

    MomentumSums linear() const { return {from_gravity_.linear.norm(), from_walls_.linear.norm(), left_over_[0]}; }
    MomentumSums angular() const { return {from_gravity_.angular.norm(), from_walls_.angular.norm(), left_over_[1]}; }

    void persist(Archive& archive)
    {
        archive(last_.linear, last_.angular, from_gravity_.linear, from_gravity_.angular, from_walls_.linear,
            from_walls_.angular, left_over_);
    }

private:
    Momentum last_, from_gravity_, from_walls_;
    std::array<double, 2> left_over_{}; ///< linear, angular
};

/// Gathers the reports of all steps into what the run says about its own error.
class RunStatistics
{
public:
    /// Takes in the report of the step that the simulation has just made.
    void add(const StepReport& report, const Simulation& simulation);

    /// The looks at the error of the solver, which whoever makes the steps lets it take.
    ErrorLooks& looks() { return looks_; }
    const ErrorLooks& looks() const { return looks_; }

    /// The companions that tell what step and solver do to the results, in the same way.
    Companions& companions() { return companions_; }
    const Companions& companions() const { return companions_; }

    ErrorSummary error(const Model& model) const;

    double contact_updates() const { return contact_updates_; } ///< contacts × sweeps

    /// Whether the last step had the spheres of the step before it.
    bool same_spheres() const { return same_spheres_; }

    void persist(Archive& archive)
    {
        archive(sums_, residuals_, energy_, momentum_, overlap_sum_, overlap_count_, contact_updates_, inserted_, left_,
            looks_, companions_);
    }

private:
    ErrorSummary sums_; ///< counts and worst values; the rest is filled in when it is asked for
    LogHistogram residuals_;
    EnergyBalance energy_;
    MomentumBalance momentum_;
    double overlap_sum_ = 0.0, overlap_count_ = 0.0; ///< over all overlapping contacts of all steps
    double contact_updates_ = 0.0;
    std::int64_t inserted_ = 0, left_ = 0; ///< up to the last step, also by escape
    bool same_spheres_ = false;
    ErrorLooks looks_;
    Companions companions_;
};

} // namespace talus
