// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/problem.hpp"

#include <Eigen/SparseCore>

namespace talus::multibody
{

/// S_ε x = G M⁻¹ Gᵀ x + Σ x, eqs. (3) and (10), without S_ε: by way of the bodies' velocities.
Eigen::VectorXd schur_times(const Problem& problem, const Eigen::VectorXd& x);

/// The problem with the bodies eliminated, eqs. (3), (4), (6): y = S_ε λ − b and the law of each constraint. It may
/// also come from elsewhere, and S_ε need not be symmetric then.
struct AssembledProblem {
    std::vector<Constraint> constraints;
    Eigen::SparseMatrix<double, Eigen::RowMajor> schur; ///< S_ε
    Eigen::VectorXd target;                             ///< b = q − G v⁽¹⁾
};

AssembledProblem assemble(const Problem& problem);

/// A current guess λ of an assembled problem's solution. Keeps a reference to the problem.
class AssembledIterate
{
public:
    explicit AssembledIterate(const AssembledProblem& problem);
    AssembledIterate(const AssembledProblem& problem, Eigen::VectorXd impulse);

    const AssembledProblem& problem() const { return *problem_; }
    const std::vector<Constraint>& constraints() const { return problem_->constraints; }
    const Eigen::VectorXd& impulse() const { return impulse_; }

    /// D_kk.
    Eigen::MatrixXd diagonal_block(std::size_t k) const;

    /// y_k = (S_ε λ − b)_k, eq. (9).
    void residual_of(std::size_t k, Eigen::Ref<Eigen::VectorXd> y) const;

    /// λ_k ← λ_k + change.
    void add(std::size_t k, const Eigen::Ref<const Eigen::VectorXd>& change);

private:
    const AssembledProblem* problem_;
    Eigen::VectorXd impulse_;
};

} // namespace talus::multibody
