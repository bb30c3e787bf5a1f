// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/iterate.hpp"
#include "core/multibody/matrix_problem.hpp"
#include "core/multibody/schur.hpp"
#include "io/problem/fclib.hpp"

/// Between FCLIB's statement of a problem and the note's: H is Gᵀ, r is λ, f is p, and w is −q.
namespace talus
{

/// The bodies' problem of a global form. Equalities come after the contacts.
/// @throws InputError where M is not a mass matrix, a contact joins bodies that cannot move, or the problem is one in
/// the plane
/// @param name with which the sentence of an error begins
multibody::ProblemWithBodies with_bodies(const FclibProblem& problem, const std::string& name);

/// The assembled problem of a local form: S = W, b = −q.
/// @throws InputError where a contact joins bodies that cannot move, or the problem is one in the plane
multibody::AssembledProblem assembled(const FclibProblem& problem, const std::string& name);

/// The global form of a problem whose constraints are contacts of three or five rows, all of the same number, and after
/// them rigid equalities, which are the columns of G.
///
/// FCLIB has no Σ. A row's compliance becomes a body of its own with one degree of freedom and the mass 1/Σ that this
/// row alone moves: W then is S_ε. Nor has it u_n ≥ min(q_n − Σ_n λ_n, u_p): where u_p is less than q_n, a contact
/// without friction, after all others, has this body give way by q_n − u_p at least, and takes what that needs.
/// @param impulse λ⁰, stored as the first guess (r, l); empty for none
FclibProblem to_fclib(const multibody::Problem& problem, const Eigen::VectorXd& impulse);

} // namespace talus
