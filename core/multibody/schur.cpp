// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/schur.hpp"

#include "core/multibody/body_constraints.hpp"

namespace talus::multibody
{
namespace
{

using Eigen::Index;

/// Appends the entries of S_ε that come of two constraints on one body, G_cb M_bb⁻¹ G_kbᵀ.
void append_coupling(const Problem& p, const BlockOfConstraint& row, const BlockOfConstraint& column,
    std::vector<Eigen::Triplet<double>>& entries)
{
    const Eigen::MatrixXd coupling = p.jacobian(row.block) * p.response(column.block);
    for (Index j = 0; j < coupling.cols(); ++j)
        for (Index i = 0; i < coupling.rows(); ++i)
            entries.emplace_back(p.constraints()[row.constraint].first_row + i,
                p.constraints()[column.constraint].first_row + j, coupling(i, j));
}

} // namespace

Eigen::VectorXd schur_times(const Problem& p, const Eigen::VectorXd& x)
{
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(p.dofs()); // M⁻¹ Gᵀ x
    for (std::size_t k = 0; k < p.constraints().size(); ++k)
        for (std::size_t i = p.first_block(k); i < p.first_block(k + 1); ++i)
            p.dofs_of(p.body_of_block(i), velocity) += p.response(i) * p.rows_of(k, x);
    Eigen::VectorXd product = p.compliance().cwiseProduct(x);
    for (std::size_t k = 0; k < p.constraints().size(); ++k)
        for (std::size_t i = p.first_block(k); i < p.first_block(k + 1); ++i)
            p.rows_of(k, product) += p.jacobian(i) * p.dofs_of(p.body_of_block(i), velocity);
    return product;
}

AssembledProblem assemble(const Problem& p)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (Index row = 0; row < p.rows(); ++row) entries.emplace_back(row, row, p.compliance()[row]);
    for (const auto& on_body : constraints_by_body(p))
        for (const auto& row : on_body)
            for (const auto& column : on_body) append_coupling(p, row, column, entries);

    AssembledProblem assembled{p.constraints(), {p.rows(), p.rows()}, p.target()};
    assembled.schur.setFromTriplets(entries.begin(), entries.end());
    for (std::size_t k = 0; k < p.constraints().size(); ++k)
        for (std::size_t i = p.first_block(k); i < p.first_block(k + 1); ++i)
            p.rows_of(k, assembled.target) -= p.jacobian(i) * p.dofs_of(p.body_of_block(i), p.free_velocity());
    return assembled;
}

AssembledIterate::AssembledIterate(const AssembledProblem& problem)
    : AssembledIterate(problem, Eigen::VectorXd::Zero(problem.target.size()))
{
}

AssembledIterate::AssembledIterate(const AssembledProblem& problem, Eigen::VectorXd impulse)
    : problem_(&problem), impulse_(std::move(impulse))
{
}

Eigen::MatrixXd AssembledIterate::diagonal_block(std::size_t k) const
{
    const Constraint& c = constraints()[k];
    Eigen::MatrixXd D(c.rows, c.rows);
    for (Index i = 0; i < c.rows; ++i)
        for (Index j = 0; j < c.rows; ++j) D(i, j) = problem_->schur.coeff(c.first_row + i, c.first_row + j);
    return D;
}

void AssembledIterate::residual_of(std::size_t k, Eigen::Ref<Eigen::VectorXd> y) const
{
    const Constraint& c = constraints()[k];
    for (Index i = 0; i < c.rows; ++i)
        y[i] = problem_->schur.row(c.first_row + i).dot(impulse_) - problem_->target[c.first_row + i];
}

void AssembledIterate::add(std::size_t k, const Eigen::Ref<const Eigen::VectorXd>& change)
{
    impulse_.segment(constraints()[k].first_row, change.size()) += change;
}

} // namespace talus::multibody
