// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/block_store.hpp"
#include "core/multibody/constraint.hpp"

namespace talus::multibody
{

/// How the problem of one constraint, all others held, is solved: the functions below.
enum class LocalSolve { block, sliding, scalar, sequential };

/// The problem of one constraint, all others held: y = D_kk (z − λ_k) + y_k for a new impulse z.
struct LocalProblem {
    const Constraint& constraint;
    BlockStore::View D;       ///< D_kk
    BlockStore::View inverse; ///< D_kk⁻¹; the pseudo-inverse where D_kk is singular
    double omega = 1.0;       ///< relaxation: each part goes as far as if its D were D/ω, the note's factor on d
};

/// What all local solves take: `z` holds λ_k on entry and the new impulse on return; `y` holds y_k on entry and is used
/// up.
using LocalVector = Eigen::Ref<Eigen::VectorXd>;

/// Eqs. (18), (19): z = λ_k − D_kk⁻¹ y_k, zero where its normal part is negative, then the projection. Exact for
/// equalities, and for contacts where D_kk is diagonal; where it is not, a coupled block may never get to rest
/// (tests/results/local_solves.md has the problems on which it does not).
void solve_by_block(const LocalProblem& local, LocalVector y, LocalVector z);

/// Eqs. (20), (21), their slip put right: what slides slides along the tangent of (18), z_t = μ z_1 w with w =
/// z_t/|z_t| of (18), and z_1 solves its own row with that. Where d₁₁ + μ (d₁₂ w₁ + d₁₃ w₂) is not positive (Painlevé),
/// (19).
void solve_along_sliding(const LocalProblem& local, LocalVector y, LocalVector z);

/// Eq. (22): one row after the other, each with the changes of those before it, projected.
void solve_by_row(const LocalProblem& local, LocalVector y, LocalVector z);

/// Normal first; then the tangent on the disk of the new normal, with the normal's change included; then the rolling
/// rows on theirs. Each part is solved exactly for itself, so what stays fixed under it obeys the law, coupled or not.
/// Equalities are solved as a block.
void solve_in_sequence(const LocalProblem& local, LocalVector y, LocalVector z);

/// Calls the one that is meant.
void solve_locally(LocalSolve how, const LocalProblem& local, LocalVector y, LocalVector z);

/// The z with |z| ≤ radius for which D z + b = −α z, α ≥ 0, and α = 0 where |z| < radius: Coulomb's law for the tangent
/// of one contact, and for a symmetric D the minimum of ½ zᵀ D z + bᵀ z on the disk (Moré & Sorensen 1983, for two
/// unknowns).
/// @pre the symmetric part of D is positive semidefinite; D need not be symmetric
Eigen::Vector2d solve_on_disk(const Eigen::Matrix2d& D, const Eigen::Vector2d& b, double radius);

} // namespace talus::multibody
