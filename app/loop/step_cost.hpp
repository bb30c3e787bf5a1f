// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/time_step.hpp"

namespace talus
{

/// What a step costs besides its sweeps, in sweeps, about.
inline constexpr double rest_of_step = 6.0;

/// What a step has cost, in contact updates: the same on every machine.
inline double cost_of(const StepReport& report)
{
    return static_cast<double>(report.contacts.count) * (report.solve.sweeps + rest_of_step * report.sub_steps);
}

} // namespace talus
