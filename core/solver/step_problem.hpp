// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/multibody/problem.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// The problem of one step in the words of the note.
///
/// Body i is sphere i with v and, where spheres turn, a = r ω; pistons follow. The constraints come in the order of a
/// sweep: contacts, those with pistons last, and then the guides of pistons.
struct StepProblem {
    multibody::Problem problem;
    Eigen::VectorXd warm_impulse; ///< λ⁰, carried over from the step before [N s; rolling rows N m s]
};

/// States the problem that a step is about to solve. The rows of a contact are its normal n (from b to a), two
/// tangents, and two axes of rolling where the scene has rolling resistance. Prescribed velocities of walls stand in q.
/// @pre prepare_step has assembled the contacts; `state` has the velocities v⁽⁰⁾
StepProblem make_step_problem(const State& state, const ContactNetwork& network, const Model& model);

} // namespace talus
