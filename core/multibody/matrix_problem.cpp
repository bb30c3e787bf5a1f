// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/matrix_problem.hpp"

#include "core/base/disjoint_sets.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace talus::multibody
{
namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using Dofs = std::vector<Index>;

/// The sets of degrees of freedom that M couples, by their first, each ascending.
std::vector<Dofs> coupled_dofs(const Eigen::SparseMatrix<double>& mass)
{
    DisjointSets sets(static_cast<std::size_t>(mass.rows()));
    for (Index column = 0; column < mass.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(mass, column); entry; ++entry)
            if (entry.value() != 0.0)
                sets.join(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(column));
    std::vector<Dofs> of_first(static_cast<std::size_t>(mass.rows()));
    for (Index dof = 0; dof < mass.rows(); ++dof)
        of_first[sets.first_of_set(static_cast<std::size_t>(dof))].push_back(dof);
    std::erase_if(of_first, [](const Dofs& dofs) { return dofs.empty(); });
    return of_first;
}

/// By degree of freedom, the constraints that touch it, ascending.
std::vector<std::vector<std::size_t>> touching(const MatrixProblem& p)
{
    std::vector<std::vector<std::size_t>> constraints(static_cast<std::size_t>(p.mass.rows()));
    Index row = 0;
    for (std::size_t k = 0; k < p.constraints.size(); ++k)
        for (const Index end = row + p.constraints[k].rows; row < end; ++row)
            for (decltype(p.jacobian)::InnerIterator entry(p.jacobian, row); entry; ++entry) {
                auto& of_dof = constraints[static_cast<std::size_t>(entry.col())];
                if (of_dof.empty() || of_dof.back() != k) of_dof.push_back(k);
            }
    return constraints;
}

/// The constraints that touch any of these.
std::vector<std::size_t> constraints_on(const Dofs& dofs, const std::vector<std::vector<std::size_t>>& touching)
{
    std::vector<std::size_t> all;
    for (const Index dof : dofs) {
        const auto& of_dof = touching[static_cast<std::size_t>(dof)];
        all.insert(all.end(), of_dof.begin(), of_dof.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// What comes out as one body.
struct Found {
    Dofs dofs;
    std::vector<std::size_t> constraints; ///< that touch it
};

/// Larger ones would hold entries by the square of their size.
constexpr std::size_t most_dofs_put_together = 12;

std::vector<Found> find_bodies(const MatrixProblem& p)
{
    const auto touched_by = touching(p);
    std::vector<Found> bodies;
    for (Dofs& dofs : coupled_dofs(p.mass)) {
        auto constraints = constraints_on(dofs, touched_by);
        const bool fits = !bodies.empty() && bodies.back().dofs.size() + dofs.size() <= most_dofs_put_together;
        if (fits && !constraints.empty() && bodies.back().constraints == constraints)
            bodies.back().dofs.insert(bodies.back().dofs.end(), dofs.begin(), dofs.end());
        else
            bodies.push_back({std::move(dofs), std::move(constraints)});
    }
    return bodies;
}

MatrixXd dense_block(const auto& matrix, const Dofs& rows, const Dofs& columns)
{
    MatrixXd block(rows.size(), columns.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns.size(); ++j)
            block(static_cast<Index>(i), static_cast<Index>(j)) = matrix.coeff(rows[i], columns[j]);
    return block;
}

void require_mass(const MatrixXd& mass, Index row)
{
    const auto problem = [&](const char* what) {
        return std::domain_error(
            "the mass matrix is not " + std::string(what) + " (block of row " + std::to_string(row) + ")");
    };
    constexpr double allowed_asymmetry = 0.01; // inertias that others have computed are symmetric to three digits
    const MatrixXd symmetric = 0.5 * (mass + mass.transpose());
    if ((mass - symmetric).norm() > allowed_asymmetry * symmetric.norm()) throw problem("symmetric");
    if (symmetric.llt().info() != Eigen::Success) throw problem("positive definite");
}

/// The blocks of M are kept dense, so M must not be much sparser than they are.
void require_bodies(const std::vector<Found>& bodies, Index entries)
{
    constexpr double always_allowed = 1e6, allowed_for_an_entry = 64.0; // some finite elements have 80 entries in a row
    double dense = 0.0;
    for (const auto& body : bodies) dense += static_cast<double>(body.dofs.size() * body.dofs.size());
    if (dense > std::max(always_allowed, allowed_for_an_entry * static_cast<double>(entries)))
        throw std::domain_error("the mass matrix couples too many degrees of freedom with each other: its blocks are "
                                "taken as dense");
}

/// p_b and M_bb of a body.
void add_body(Problem& problem, const MatrixProblem& p, const Dofs& dofs)
{
    const MatrixXd mass = dense_block(p.mass, dofs, dofs);
    require_mass(mass, dofs.front());
    problem.add_body(mass, p.momentum(dofs));
}

} // namespace

VectorXd ProblemWithBodies::in_order_of_matrices(const VectorXd& velocity) const
{
    VectorXd ordered(velocity.size());
    ordered(dof) = velocity;
    return ordered;
}

ProblemWithBodies with_bodies(const MatrixProblem& p)
{
    const auto bodies = find_bodies(p);
    require_bodies(bodies, p.mass.nonZeros());
    ProblemWithBodies result;
    std::vector<std::vector<std::size_t>> bodies_of(p.constraints.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        add_body(result.problem, p, bodies[b].dofs);
        result.dof.insert(result.dof.end(), bodies[b].dofs.begin(), bodies[b].dofs.end());
        for (const auto k : bodies[b].constraints) bodies_of[k].push_back(b);
    }
    Index first_row = 0;
    for (std::size_t k = 0; k < p.constraints.size(); ++k) {
        const Index count = p.constraints[k].rows;
        Dofs rows(static_cast<std::size_t>(count));
        std::iota(rows.begin(), rows.end(), first_row);
        std::vector<BodyRows> blocks;
        for (const auto b : bodies_of[k]) blocks.push_back({b, dense_block(p.jacobian, rows, bodies[b].dofs)});
        result.problem.add_constraint(
            p.constraints[k], blocks, p.compliance.segment(first_row, count), p.target.segment(first_row, count));
        first_row += count;
    }
    return result;
}

} // namespace talus::multibody
