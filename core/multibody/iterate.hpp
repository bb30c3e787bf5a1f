// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/problem.hpp"

namespace talus::multibody
{

/// A current guess of a solution: impulses λ and the velocities v = v⁽¹⁾ + M⁻¹ Gᵀ λ that belong to them, eq. (12).
///
/// Keeps a reference to the problem.
class Iterate
{
public:
    /// λ = 0.
    explicit Iterate(const Problem& problem);

    /// Starts with λ⁰: v = v⁽¹⁾ + M⁻¹ Gᵀ λ⁰, which the note's algorithms leave out.
    Iterate(const Problem& problem, const Eigen::VectorXd& impulse);

    const Problem& problem() const { return *problem_; }
    const std::vector<Constraint>& constraints() const { return problem_->constraints(); }
    const Eigen::VectorXd& impulse() const { return impulse_; }

    /// v; whoever changes it from outside (bodies that other constraints act on too) keeps λ.
    Eigen::VectorXd& velocity() { return velocity_; }
    const Eigen::VectorXd& velocity() const { return velocity_; }

    /// D_kk.
    Eigen::MatrixXd diagonal_block(std::size_t k) const { return problem_->diagonal_block(k); }

    /// y_k = Σ_b G_kb v_b + Σ_kk λ_k − q_k, eq. (16).
    void residual_of(std::size_t k, Eigen::Ref<Eigen::VectorXd> y) const;

    /// λ_k ← λ_k + change; v ← v + M⁻¹ G_•kᵀ change, eq. (15).
    void add(std::size_t k, const Eigen::Ref<const Eigen::VectorXd>& change);

private:
    const Problem* problem_;
    Eigen::VectorXd velocity_, impulse_;
};

} // namespace talus::multibody
