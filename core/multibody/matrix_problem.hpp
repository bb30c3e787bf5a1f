// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/problem.hpp"

#include <Eigen/SparseCore>

#include <vector>

namespace talus::multibody
{

/// The problem as the matrices of eq. (1), of which nobody says what the bodies are.
struct MatrixProblem {
    Eigen::SparseMatrix<double> mass;                      ///< M, n × n, symmetric and positive definite
    Eigen::VectorXd momentum;                              ///< p, n
    Eigen::SparseMatrix<double, Eigen::RowMajor> jacobian; ///< G, m × n
    Eigen::VectorXd compliance;                            ///< diagonal of Σ, m
    Eigen::VectorXd target;                                ///< q, m
    std::vector<Constraint> constraints;                   ///< law, rows and coefficients; their rows follow each other
};

/// The same problem with bodies, and where its velocities stand in those of the matrices.
struct ProblemWithBodies {
    Problem problem;
    std::vector<Eigen::Index> dof; ///< by degree of freedom of `problem`: its number in the matrices

    /// The velocities of the matrices' order.
    Eigen::VectorXd in_order_of_matrices(const Eigen::VectorXd& velocity) const;
};

/// Finds bodies: degrees of freedom that M couples belong to one, and neighbours that the same constraints touch are
/// put together, for long blocks are swept faster than short ones.
/// @throws std::domain_error where M is not symmetric (to 1 %) or not positive definite, with its row, or couples so
/// many degrees of freedom that dense blocks would be far larger than M
ProblemWithBodies with_bodies(const MatrixProblem& matrices);

} // namespace talus::multibody
