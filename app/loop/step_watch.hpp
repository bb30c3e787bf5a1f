// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/time_step.hpp"
#include "core/world/model.hpp"
#include "scenarios/simulation.hpp"

#include <string>

namespace talus
{

/// Watches whether the time step is small enough for what happens, and says once which would be.
class StepWatch
{
public:
    explicit StepWatch(const Model& model) : model_(model) {}

    /// Takes in the report of a step. @returns a warning, or nothing
    /// @param simulation has made the step: the warning names the spheres and walls in question where it is given
    std::string warning_after(const StepReport& report, const Simulation* simulation = nullptr);

private:
    const Model& model_;
    int steps_with_long_moves_ = 0;
    double fastest_ = 0.0; ///< in those [m/s]
    int deep_steps_ = 0;   ///< in a row with deep overlap
    double deepest_ = 0.0; ///< in those [m]
    bool move_told_ = false, overlap_told_ = false;

    std::string warning_of_moves(const StepReport& report);
    std::string warning_of_overlap(const StepReport& report, const Simulation* simulation);
};

} // namespace talus
