// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/block_store.hpp"
#include "core/multibody/constraint.hpp"

#include <cstddef>
#include <vector>

namespace talus::multibody
{

/// G_kb: what one body contributes to the rows of one constraint.
struct BodyRows {
    std::size_t body;
    Eigen::MatrixXd jacobian; ///< rows of the constraint × degrees of freedom of the body
};

/// The problem of the note, eq. (1), with laws for the impulses:
///
///   M v = p + Gᵀ λ,   y = G v + Σ λ − q,   and the law of each constraint between its λ_k and y_k.
///
/// Bodies have any number of degrees of freedom; M is block diagonal, a block for each body. A constraint touches any
/// number of bodies with any number of rows.
class Problem
{
public:
    using VectorView = Eigen::Map<const Eigen::VectorXd>;

    /// Appends a body and returns its number.
    /// @param mass M_bb, symmetric and positive definite; @param momentum p_b = M v⁽⁰⁾ + h f⁽⁰⁾, eq. (2)
    std::size_t add_body(const Eigen::MatrixXd& mass, const Eigen::VectorXd& momentum);

    /// Appends a constraint and returns its number; its `first_row` and `rows` are set here.
    /// @param bodies each at most once; @param compliance diagonal of Σ_kk, ≥ 0; @param target q_k
    std::size_t add_constraint(Constraint law, const std::vector<BodyRows>& bodies, const Eigen::VectorXd& compliance,
        const Eigen::VectorXd& target);

    std::size_t body_count() const { return mass_.size(); }
    const std::vector<Constraint>& constraints() const { return constraints_; }
    Eigen::Index dofs() const { return static_cast<Eigen::Index>(free_velocity_.size()); } ///< n
    Eigen::Index rows() const { return static_cast<Eigen::Index>(target_.size()); }        ///< m

    BlockStore::View mass(std::size_t b) const { return mass_[b]; } ///< M_bb
    Eigen::Index first_dof(std::size_t b) const { return first_dof_[b]; }
    VectorView free_velocity() const { return view(free_velocity_); } ///< v⁽¹⁾ = M⁻¹ p, eq. (5)
    VectorView compliance() const { return view(compliance_); }       ///< diagonal of Σ
    VectorView target() const { return view(target_); }               ///< q

    /// The blocks of constraint k are those from first_block(k) to first_block(k + 1) − 1.
    std::size_t first_block(std::size_t k) const { return first_block_[k]; }
    std::size_t block_count() const { return body_of_block_.size(); }
    std::size_t body_of_block(std::size_t i) const { return body_of_block_[i]; }
    BlockStore::View jacobian(std::size_t i) const { return jacobian_[i]; } ///< G_kb
    BlockStore::View response(std::size_t i) const { return response_[i]; } ///< M_bb⁻¹ G_kbᵀ

    /// D_kk = Σ_b G_kb M_bb⁻¹ G_kbᵀ + Σ_kk.
    Eigen::MatrixXd diagonal_block(std::size_t k) const;

    /// The rows of constraint k in a vector over all rows, and the degrees of freedom of body b in one over all of
    /// them.
    template <class Vector> auto rows_of(std::size_t k, Vector&& vector) const
    {
        return vector.segment(constraints_[k].first_row, constraints_[k].rows);
    }
    template <class Vector> auto dofs_of(std::size_t b, Vector&& vector) const
    {
        return vector.segment(first_dof_[b], mass_[b].rows());
    }

private:
    BlockStore mass_, inverse_mass_;
    std::vector<Eigen::Index> first_dof_;
    std::vector<double> free_velocity_;

    std::vector<Constraint> constraints_;
    std::vector<double> compliance_, target_;
    std::vector<std::size_t> first_block_ = {0};
    std::vector<std::size_t> body_of_block_;
    BlockStore jacobian_, response_;

    static VectorView view(const std::vector<double>& vector)
    {
        return {vector.data(), static_cast<Eigen::Index>(vector.size())};
    }
};

} // namespace talus::multibody
