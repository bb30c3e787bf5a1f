// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/error_measures.hpp"

#include "core/multibody/iterate.hpp"
#include "core/multibody/schur.hpp"

#include <algorithm>
#include <cmath>

namespace talus::multibody
{
namespace
{

using Eigen::Index;

/// Calls visit(constraint, δ_k) for every constraint.
template <class AnyIterate, class Visit>
void for_each_correction(const AnyIterate& iterate, const DiagonalBlocks& blocks, Visit&& visit)
{
    Eigen::VectorXd y, z;
    for (std::size_t k = 0; k < iterate.constraints().size(); ++k) {
        const Constraint& constraint = iterate.constraints()[k];
        const auto impulse = iterate.impulse().segment(constraint.first_row, constraint.rows);
        const auto scale = blocks.scale().segment(constraint.first_row, constraint.rows);
        y.resize(constraint.rows);
        iterate.residual_of(k, y);
        limit_parting(constraint, impulse[0], scale[0], y);
        z = impulse - (scale.array() > 0.0).select(y.cwiseQuotient(scale), 0.0); // scale zero: nothing can move
        project(constraint, z);
        visit(constraint, impulse - z);
    }
}

bool is_rolling_row(const Constraint& constraint, Index row)
{
    return constraint.law == Law::contact && row > tangent_rows;
}

} // namespace

template <class AnyIterate> SweepSums natural_map_sums(const AnyIterate& iterate, const DiagonalBlocks& blocks)
{
    SweepSums sums;
    for_each_correction(iterate, blocks, [&](const Constraint& constraint, const Eigen::VectorXd& correction) {
        const auto weight = blocks.weight().segment(constraint.first_row, constraint.rows);
        sums.change += weight.dot(correction.cwiseAbs2());
    });
    sums.size = blocks.weight().dot(iterate.impulse().cwiseAbs2());
    return sums;
}

double relative_size(const SweepSums& sums)
{
    return sums.change == 0.0 ? 0.0 : std::sqrt(sums.change / sums.size);
}

template <class AnyIterate> ErrorMeasures measure_errors(const AnyIterate& iterate)
{
    const DiagonalBlocks blocks(iterate, LocalSolve::sequential);
    ErrorMeasures errors;
    errors.natural_map = relative_size(natural_map_sums(iterate, blocks));
    for_each_correction(iterate, blocks, [&](const Constraint& constraint, const Eigen::VectorXd& correction) {
        for (Index i = 0; i < constraint.rows; ++i) {
            double& worst =
                is_rolling_row(constraint, i) ? errors.worst_spin_violation : errors.worst_velocity_violation;
            worst = std::max(worst, std::abs(correction[i]) * blocks.scale()[constraint.first_row + i]);
        }
        const auto impulse = iterate.impulse().segment(constraint.first_row, constraint.rows);
        errors.cone_violation = std::max(errors.cone_violation, cone_violation(constraint, impulse));
    });
    return errors;
}

template ErrorMeasures measure_errors(const Iterate&);
template ErrorMeasures measure_errors(const AssembledIterate&);
template SweepSums natural_map_sums(const Iterate&, const DiagonalBlocks&);
template SweepSums natural_map_sums(const AssembledIterate&, const DiagonalBlocks&);

} // namespace talus::multibody
