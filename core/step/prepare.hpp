// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/assembly.hpp"
#include "core/contacts/contact_network.hpp"
#include "core/contacts/flight.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"
#include "core/world/step_length.hpp"

#include <functional>
#include <vector>

namespace talus
{

/// The phases of a step, in order. `advance` calls the observer when one begins.
enum class Phase { search, assembly, warm_start, sweeps, positions, report };

using PhaseObserver = std::function<void(Phase)>;

/// What the search of a step did.
struct SearchReport {
    std::size_t candidates = 0; ///< listed pairs, walls included
    std::size_t searched = 0;   ///< spheres whose neighbours were searched anew

    void then(const SearchReport& next); ///< the next sub-step
};

/// A step before its impulses: who touches whom, and under which law.
struct PreparedStep {
    std::vector<PlacedWall> walls; ///< where they stand, and their mean velocities over the step
    SearchReport search;
    ContactSurvey contacts;
    std::vector<Flight> flights;
    double impact_ratio = 0.0; ///< of stand_beside_impacts
};

/// The beginning of a step, from which `network` has the problem that the rest of it solves. Positions and velocities
/// stay as they are; the spheres' order may change.
PreparedStep prepare_step(State& state, ContactNetwork& network, const Model& model, const StepLength& step,
    const PhaseObserver& observer = {});

} // namespace talus
