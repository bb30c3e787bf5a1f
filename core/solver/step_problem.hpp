// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/multibody/problem.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// What the problem of a step does not say of a contact.
struct ContactOrigin {
    std::int32_t a = 0, b = 0; ///< indices of the sphere, and of the other sphere or the wall
    bool with_wall = false;
    double gap = 0.0; ///< [m]; < 0: overlap
    ContactKind kind = ContactKind::resting;
    Vec3 point = Vec3::Zero(); ///< where it acts, halfway across the gap [m]
};

/// The problem of one step in the words of the note.
///
/// The bodies are the spheres in the order of their ids with v and, where spheres turn, a = r ω; pistons follow. The
/// constraints come in the order of a sweep: contacts, those with pistons last, and then the guides of pistons.
struct StepProblem {
    multibody::Problem problem;
    Eigen::VectorXd warm_impulse;            ///< λ⁰, carried over from the step before [N s; rolling rows N m s]
    std::vector<std::size_t> sphere_of_body; ///< index of the sphere that a body is, without pistons
    std::vector<ContactOrigin> contacts;     ///< in the order of the constraints
};

/// States the problem that a step is about to solve. The rows of a contact are its normal n (from b to a), two
/// tangents, and two axes of rolling where the scene has rolling resistance. Prescribed velocities of walls stand in q.
/// @pre prepare_step has assembled the contacts; `state` has the velocities v⁽⁰⁾
StepProblem make_step_problem(const State& state, const ContactNetwork& network, const Model& model);

} // namespace talus
