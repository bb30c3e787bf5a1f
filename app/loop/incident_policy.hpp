// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/time_step.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

namespace talus
{

/// What a scene wants done about the incidents of a step (world.on_escape, solver.on_no_solution).
class IncidentPolicy
{
public:
    explicit IncidentPolicy(const scene::Scene& scene)
        : remove_escaped_(scene.world.on_escape == "remove"), go_on_pressed_(scene.solver.on_no_solution == "go_on")
    {
    }

    /// Whether one of them ends the run.
    bool stops(const StepReport& report) const;

private:
    bool remove_escaped_;
    bool go_on_pressed_;
};

/// Takes the escaped spheres of a step that does not end the run out of the world.
void take_out_escaped(Simulation& simulation, const StepReport& report);

} // namespace talus
