// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/simulation.hpp"
#include "scenarios/builder/bed.hpp"
#include "scenarios/scene.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{

/// What the automatic step keeps to. METHOD ("The length of the step") says what holds the defaults.
struct StepTargets {
    double overlap = 0.002; ///< mean of loaded contacts, of what the law's own softness makes [d]
    double creep = 0.0036;  ///< h by a sweep, of those that a step makes at least [sqrt(d/gravity)]
    double approach = 0.1;  ///< how far two surfaces come nearer in a step, one of them thrown back [d]
};

/// The step of a run, and what it was chosen from.
struct StepChoice {
    double step = 0.0;            ///< h [s]
    bool given = false;           ///< by the scene
    int min_sweeps = 0;           ///< that go with it
    double by_overlap = infinity; ///< the longest step that keeps to each target, with the sweeps that go with it [s]
    double by_creep = infinity;
    double by_approach = infinity;
    double by_attraction = infinity; ///< that keeps what attraction alone brings nearer in a step to the same
    double by_heavy = infinity;      ///< that keeps what lies below the heaviest sphere from overlapping by 0.02 d [s]
    double closing_speed = 0.0;      ///< of surfaces that will touch, at most [m/s]
    double restitution = 0.0;        ///< with which these part, at most
    double speed_limit = 0.0;        ///< what is faster is a blow-up [m/s]

    double by_samples = infinity; ///< the time between samples, which it is no longer than [s]

    /// With which what has been thrown back meets what comes after it, at most [m/s].
    double meeting_speed() const { return (1.0 + restitution) * closing_speed; }

    /// Infinite where neither gravity nor a speed says anything.
    double automatic() const
    {
        const double longest = std::min({by_overlap, by_creep, by_approach, by_attraction, by_heavy});
        return std::isfinite(longest) ? std::min(longest, by_samples) : longest;
    }
};

/// The step of the scene, the one given or the longest that keeps to the targets, and the sweeps that it needs, N_min.
///
/// With `matched` the overlap of a bed of depth Z goes with h² gravity Z/N_min; a load takes sweeps to go through
/// it. So N_min grows as the step, from 2 up to 4, unless the scene gives it.
/// @param simulation its spheres are there, and its model has its solver
/// @throws SceneError where neither gravity nor a speed gives a step
StepChoice choose_step(
    const scene::Scene& scene, const Simulation& simulation, const Bed& bed, const StepTargets& targets = {});

} // namespace talus
