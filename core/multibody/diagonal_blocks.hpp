// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/local_solve.hpp"

#include <vector>

namespace talus::multibody
{

/// D_kk of all constraints, and what follows from them; line 4 of the note's algorithms.
class DiagonalBlocks
{
public:
    /// @param iterate an Iterate or an AssembledIterate; @param how which local solve they are for: not all need the
    /// inverse
    template <class AnyIterate> DiagonalBlocks(const AnyIterate& iterate, LocalSolve how);

    /// The problem of constraint k. @param constraint the same one; @param omega relaxation
    LocalProblem local(const Constraint& constraint, std::size_t k, double omega = 1.0) const
    {
        return {constraint, D_[k], inverse_[k], omega};
    }

    /// By row, what turns an impulse into the velocity that it makes in its own row [1/kg; rolling rows 1/(kg m²)]:
    /// d_ii, for the two rows of a disk their mean, for it does not depend on the tangents chosen.
    const Eigen::VectorXd& scale() const { return scale_; }

    /// By row, W in the sums of the stopping rule: the scale, but for a contact's tangents that of its normal.
    const Eigen::VectorXd& weight() const { return weight_; }

private:
    BlockStore D_, inverse_;
    Eigen::VectorXd scale_, weight_;
};

} // namespace talus::multibody
