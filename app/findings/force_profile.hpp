// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/step/time_step.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// The force that holds spheres up: by all walls that are not pistons, and through level cuts, on the spheres above a
/// cut by those below it. The residual of a step is blind to an error of it that is smooth over many layers.
class ForceProfile
{
public:
    /// Cuts are laid evenly between the foot of the lowest sphere and the top of the highest, and stay there.
    /// @param up unit
    ForceProfile(const State& state, const Vec3& up, std::size_t cuts);

    /// Of the last step: by walls first, then through the cuts from below [N].
    /// @param network whose contacts are those of that step, and name spheres of this state; @param time_step whole [s]
    std::vector<double> forces(
        const State& state, const ContactNetwork& network, const StepReport& report, double time_step) const;

private:
    Vec3 up_;
    double foot_ = 0.0, spacing_ = 0.0; ///< of cuts [m]
    std::size_t cuts_;
};

} // namespace talus
