// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/carry.hpp"
#include "core/contacts/loads.hpp"
#include "core/deep_beds/pressure_scaling.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "core/step/diagnostics.hpp"
#include "core/step/prepare.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"
#include "core/world/step_length.hpp"

#include <optional>
#include <vector>

namespace talus
{

/// Two that come near each other.
struct Approach {
    double speed = 0.0;       ///< −u_n [m/s]
    std::int64_t sphere = -1; ///< its id
    std::int64_t other = -1;  ///< id of the sphere that it meets; −1: a wall
    std::int64_t wall = -1;   ///< the wall's index; −1: a sphere
};

/// What pours and outlets carried in and out between two steps.
struct Exchange {
    std::int64_t came = 0, left = 0; ///< spheres
    double energy = 0.0;             ///< of those that came less of those that left [J]
};

/// How a step went, by the stage that found it. Returned by value, so nothing leaks from one step into the next. Of a
/// step that was split, each part says what of its sub-steps it keeps (`then`).
struct StepReport {
    int sub_steps = 1;  ///< into which the step was split …
    Approach split_for; ///< … for the sake of these; of a step that was split
    Exchange exchange;  ///< before the step
    SearchReport search;
    ContactSurvey contacts;
    SolveReport solve;
    ScalingReport scaling;
    ContactOutcome outcome;
    StateSurvey bodies;
    std::vector<WallLoad> wall_loads; ///< by wall; empty unless a sensor asks for them
    double lifted_energy = 0.0;       ///< potential energy that moves of positions without velocity added [J]
    double attraction_work = 0.0;     ///< of what attracts each other, on its way together [J]

    void then(StepReport next); ///< the next sub-step
};

/// Advances the state by one step h of the model: the step that runs, tests and tools call.
///
/// A contact is seen before it closes if the velocities with which a step begins would close it. A sphere that is
/// struck or thrown back within the step meets others unseen, so it must not come so far that the next step finds it on
/// their other side. Hence a step is split into equal sub-steps, each a whole step of the method, where two that touch
/// in it come nearer than 0.2 smallest diameters (in sub-steps 0.1), or where impulses throw something further than 0.4
/// from where it would have come. Only what moves against each other counts: what falls or is carried along splits
/// nothing. Sub-steps keep what depends on the length of the step: the stiffness of shallow contacts, the slowest
/// impact.
///
/// `network` belongs to `state`: it carries the candidate list and the impulses from step to step, and has the contacts
/// of the last sub-step, whose impulses have acted for `carried.impulse_step`. (In sub_steps.cpp.)
StepReport advance(State& state, ContactNetwork& network, const Model& model, const PhaseObserver& observer = {});

/// The method itself: one step of this length, velocities first, then positions. Nothing if it is too long for what
/// approaches or is thrown in it: then nothing has moved, velocities are as they were, and the contacts of the network
/// are unsolved.
/// @param in_any_case it is made however long it is
std::optional<StepReport> advance_once(const StepLength& step, bool in_any_case, State& state, ContactNetwork& network,
    const Model& model, const PhaseObserver& observer);

} // namespace talus
