// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/diagonal_blocks.hpp"

#include "core/multibody/iterate.hpp"
#include "core/multibody/schur.hpp"

#include <Eigen/QR>

namespace talus::multibody
{
namespace
{

Eigen::MatrixXd inverse_or_empty(const Eigen::MatrixXd& D, Law law, LocalSolve how)
{
    const bool as_block = how == LocalSolve::block || how == LocalSolve::sliding;
    if (law != Law::equality && !as_block) return {};
    return D.completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::VectorXd row_scales(const Constraint& constraint, const Eigen::MatrixXd& D)
{
    Eigen::VectorXd scale = D.diagonal();
    if (constraint.law != Law::contact) return scale;
    const auto level = [&](Eigen::Index first, Eigen::Index rows) {
        scale.segment(first, rows).setConstant(scale.segment(first, rows).mean());
    };
    level(1, tangent_rows);
    if (constraint.rolls()) level(1 + tangent_rows, rolling_rows);
    return scale;
}

} // namespace

template <class AnyIterate> DiagonalBlocks::DiagonalBlocks(const AnyIterate& iterate, LocalSolve how)
{
    scale_.resize(iterate.impulse().size());
    weight_.resize(iterate.impulse().size());
    for (std::size_t k = 0; k < iterate.constraints().size(); ++k) {
        const Constraint& constraint = iterate.constraints()[k];
        const Eigen::MatrixXd D = iterate.diagonal_block(k);
        D_.add(D);
        inverse_.add(inverse_or_empty(D, constraint.law, how));
        Eigen::VectorXd weight = row_scales(constraint, D);
        scale_.segment(constraint.first_row, constraint.rows) = weight;
        if (constraint.law == Law::contact) weight.segment<tangent_rows>(1).setConstant(weight[0]);
        weight_.segment(constraint.first_row, constraint.rows) = weight;
    }
}

template DiagonalBlocks::DiagonalBlocks(const Iterate&, LocalSolve);
template DiagonalBlocks::DiagonalBlocks(const AssembledIterate&, LocalSolve);

} // namespace talus::multibody
