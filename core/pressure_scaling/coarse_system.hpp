// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <utility>

#include <vector>

namespace talus
{

/// A small symmetric system A x = b, A positive semi-definite: sparse rows, and for each body that many nodes share one
/// term w c cᵀ besides.
struct CoarseSystem {
    struct SharedBody {
        double inverse_mass = 0.0; ///< w
        Eigen::VectorXd impulse;   ///< c
    };

    std::vector<std::size_t> first_entry = {0}; ///< of each row; rows + 1
    std::vector<std::int32_t> column;
    std::vector<double> value;
    std::vector<SharedBody> shared;

    Eigen::Index size() const { return static_cast<Eigen::Index>(first_entry.size()) - 1; }
    Eigen::VectorXd diagonal() const;

    /// A x.
    Eigen::VectorXd times(const Eigen::VectorXd& x) const;

    /// x with A x = b by conjugate gradients, scaled by the diagonal, stopped when r·D⁻¹r is `tolerance` of that of b.
    /// Where a row is empty, x is zero.
    Eigen::VectorXd solved(const Eigen::VectorXd& b, double tolerance, int most_iterations) const;
};

} // namespace talus
