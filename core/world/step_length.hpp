// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/state.hpp"

namespace talus
{

/// How long a step is: the model's time step, or one of the equal sub-steps into which it is split where something is
/// too fast for it.
struct StepLength {
    double whole = 0.0; ///< the model's time step [s]
    int parts = 1;      ///< sub-steps

    double h() const { return whole / parts; } ///< of this step or sub-step [s]
    bool is_split() const { return parts > 1; }

    /// Time goes on by this step or sub-step. After a whole one it is a multiple of it: rounding does not add up.
    void pass(State& state) const
    {
        state.time = is_split() ? state.time + h() : static_cast<double>(++state.steps) * whole;
    }
};

} // namespace talus
