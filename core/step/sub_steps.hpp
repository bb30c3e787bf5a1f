// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/time_step.hpp"

namespace talus
{

/// Advances the state by one step h, as `advance` does, but in equal sub-steps where something is too fast for it.
///
/// A contact is seen before it closes if the velocities with which a step begins would close it. A sphere that is
/// struck or thrown back within the step meets others unseen, so it must not come so far that the next step finds it on
/// their other side. Hence a step in which the fastest would move further than 0.2 smallest diameters is split into
/// equal sub-steps, each a whole step of the method, in which it moves 0.1; and a step or sub-step after whose impulses
/// anything would move further than 0.4 is taken back and made in smaller ones. Where walls move, their speed counts as
/// well.
///
/// Sub-steps keep what depends on the length of the step: the stiffness of shallow contacts, the slowest impact. Time
/// is that of whole steps when they are over. `contacts` has the last of them, whose impulses have acted for
/// impulse_step.
StepReport make_step(State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer = {});

} // namespace talus
