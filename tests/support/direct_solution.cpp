// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/direct_solution.hpp"

#include <Eigen/QR>
#include <Eigen/SparseLU>

namespace talus::test
{
namespace
{

using Eigen::Index;
using multibody::Problem;

/// The matrix of eq. (1), [M −Gᵀ; G Σ].
Eigen::SparseMatrix<double> system_matrix(const Problem& p)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t b = 0; b < p.body_count(); ++b)
        for (Index j = 0; j < p.mass(b).cols(); ++j)
            for (Index i = 0; i < p.mass(b).rows(); ++i)
                entries.emplace_back(p.first_dof(b) + i, p.first_dof(b) + j, p.mass(b)(i, j));
    for (std::size_t k = 0; k < p.constraints().size(); ++k)
        for (std::size_t block = p.first_block(k); block < p.first_block(k + 1); ++block) {
            const auto G = p.jacobian(block);
            const Index row = p.constraints()[k].first_row, dof = p.first_dof(p.body_of_block(block));
            for (Index i = 0; i < G.rows(); ++i)
                for (Index j = 0; j < G.cols(); ++j) {
                    entries.emplace_back(p.dofs() + row + i, dof + j, G(i, j));
                    entries.emplace_back(dof + j, p.dofs() + row + i, -G(i, j));
                }
        }
    for (Index row = 0; row < p.rows(); ++row)
        entries.emplace_back(p.dofs() + row, p.dofs() + row, p.compliance()[row]);
    Eigen::SparseMatrix<double> matrix(p.dofs() + p.rows(), p.dofs() + p.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// (p, q).
Eigen::VectorXd right_hand_side(const Problem& p)
{
    Eigen::VectorXd side(p.dofs() + p.rows());
    for (std::size_t b = 0; b < p.body_count(); ++b) p.dofs_of(b, side) = p.mass(b) * p.dofs_of(b, p.free_velocity());
    side.tail(p.rows()) = p.target();
    return side;
}

DirectSolution split(const Problem& p, const Eigen::VectorXd& solution)
{
    return {solution.head(p.dofs()), solution.tail(p.rows())};
}

} // namespace

DirectSolution solve_dense(const Problem& p)
{
    const Eigen::MatrixXd matrix(system_matrix(p));
    return split(p, matrix.completeOrthogonalDecomposition().solve(right_hand_side(p)));
}

DirectSolution solve_sparse(const Problem& p)
{
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> decomposition(system_matrix(p));
    return split(p, decomposition.solve(right_hand_side(p)));
}

} // namespace talus::test
