// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/problem.hpp"

namespace talus::test
{

/// v and λ of eq. (1) as a linear system; only for problems whose constraints are all equalities.
struct DirectSolution {
    Eigen::VectorXd velocity, impulse;
};

/// By Eigen's dense decomposition; of the many λ of a rank-deficient problem the shortest.
DirectSolution solve_dense(const multibody::Problem& problem);

/// By Eigen's sparse LU decomposition. @pre eq. (1) has one solution
DirectSolution solve_sparse(const multibody::Problem& problem);

} // namespace talus::test
