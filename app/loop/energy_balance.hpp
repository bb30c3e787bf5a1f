// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/step/time_step.hpp"

#include <optional>

namespace talus
{

/// Falls and rises of the total energy from step to step: kinetic + potential + stored in the contacts, less what
/// moving walls, loads on pistons, and gravity along periodic axes, put in. Only steps with the same spheres are
/// compared; what pours and outlets carry in and out is not a change of theirs.
class EnergyBalance
{
public:
    /// @param same_spheres whether those in the step are those of the step before
    void add(const StepReport& report, bool same_spheres);

    double lost() const { return lost_; }     ///< sum of the falls [J]
    double gained() const { return gained_; } ///< sum of the rises [J]
    double put_in() const { return put_in_; } ///< work of moving walls, loads, and gravity along periodic axes [J]

    void persist(Archive& archive) { archive(lost_, gained_, put_in_, work_, motion_energy_, total_energy_); }

private:
    double lost_ = 0.0, gained_ = 0.0, put_in_ = 0.0;
    double work_ = 0.0;                   ///< put in by the last step
    std::optional<double> motion_energy_; ///< kinetic + potential at the end of the last step
    std::optional<double> total_energy_;  ///< at the end of the step before it
};

} // namespace talus
