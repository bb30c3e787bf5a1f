// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib_problem.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::VectorXd;
using multibody::Constraint;
using multibody::Law;

std::vector<Constraint> contacts_of(const FclibProblem& file)
{
    std::vector<Constraint> contacts;
    for (Index k = 0; k < file.contacts(); ++k)
        contacts.push_back({.law = Law::contact,
            .first_row = file.rows_per_contact * k,
            .rows = file.rows_per_contact,
            .friction = file.mu[k],
            .rolling_reach = file.mu_r.size() > 0 ? file.mu_r[k] : 0.0});
    return contacts;
}

[[noreturn]] void refuse(const std::string& name, const Constraint& constraint, std::size_t k, const char* what)
{
    throw InputError(fmt::format("{}: {} {}: {}", name, constraint.law == Law::equality ? "row of G" : "contact",
        constraint.law == Law::equality ? constraint.first_row : static_cast<Index>(k), what));
}

/// Where no reaction of its own can answer for a normal velocity, no error measure can weigh it.
template <class AnyIterate> void require_answers(const AnyIterate& iterate, const std::string& name)
{
    for (std::size_t k = 0; k < iterate.constraints().size(); ++k) {
        const Constraint& constraint = iterate.constraints()[k];
        const VectorXd diagonal = iterate.diagonal_block(k).diagonal();
        if (diagonal.minCoeff() < 0.0) refuse(name, constraint, k, "the diagonal of W is negative");
        if (diagonal[0] == 0.0)
            refuse(name, constraint, k, "its reaction changes no velocity of its own; do its bodies move at all?");
    }
}

/// @throws InputError
void require_space(const FclibProblem& file, const std::string& name)
{
    if (file.rows_per_contact == 2)
        throw InputError(name + ": a problem in the plane, with two rows a contact; only those in space are solved");
}

VectorXd joined(const VectorXd& a, const VectorXd& b)
{
    VectorXd both(a.size() + b.size());
    both << a, b;
    return both;
}

multibody::MatrixProblem matrices_of(const FclibProblem& file)
{
    multibody::MatrixProblem p;
    p.mass = file.M;
    p.momentum = file.f;
    p.constraints = contacts_of(file);
    const Index contact_rows = file.H.cols();
    for (Index k = 0; k < file.G.cols(); ++k)
        p.constraints.push_back({.law = Law::equality, .first_row = contact_rows + k, .rows = 1});
    std::vector<Eigen::Triplet<double>> entries;
    const auto append = [&](const Eigen::SparseMatrix<double>& transposed, Index first_row) {
        for (Index column = 0; column < transposed.cols(); ++column)
            for (Eigen::SparseMatrix<double>::InnerIterator entry(transposed, column); entry; ++entry)
                entries.emplace_back(first_row + column, entry.row(), entry.value());
    };
    append(file.H, 0);
    append(file.G, contact_rows);
    p.jacobian.resize(contact_rows + file.G.cols(), file.M.rows());
    p.jacobian.setFromTriplets(entries.begin(), entries.end());
    p.target = -joined(file.w, file.b);
    p.compliance = VectorXd::Zero(p.target.size());
    return p;
}

/// A matrix made of blocks, entry by entry.
class SparseEntries
{
public:
    void add(Index first_row, Index first_column, const Eigen::MatrixXd& block)
    {
        for (Index j = 0; j < block.cols(); ++j)
            for (Index i = 0; i < block.rows(); ++i)
                if (block(i, j) != 0.0) entries_.emplace_back(first_row + i, first_column + j, block(i, j));
    }

    Eigen::SparseMatrix<double> matrix(Index rows, Index columns) const
    {
        Eigen::SparseMatrix<double> matrix(rows, columns);
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        return matrix;
    }

private:
    std::vector<Eigen::Triplet<double>> entries_;
};

void set_friction(FclibProblem& file, const std::vector<Constraint>& contacts)
{
    const auto count = static_cast<Index>(contacts.size());
    const bool rolls = !contacts.empty() && contacts.front().rolls();
    file.form = rolls ? FclibForm::global_rolling : FclibForm::global;
    file.rows_per_contact = rolls ? 5 : 3;
    file.mu.resize(count);
    file.mu_r.resize(rolls ? count : 0);
    for (Index k = 0; k < count; ++k) {
        file.mu[k] = contacts[static_cast<std::size_t>(k)].friction;
        if (rolls) file.mu_r[k] = contacts[static_cast<std::size_t>(k)].rolling_reach;
    }
}

std::vector<Constraint> contacts_in(const multibody::Problem& problem)
{
    std::vector<Constraint> contacts = problem.constraints();
    std::erase_if(contacts, [](const Constraint& constraint) { return constraint.law != Law::contact; });
    return contacts;
}

/// M with a body for each compliance, H and G.
void set_matrices(FclibProblem& file, const multibody::Problem& problem, Index contact_rows)
{
    SparseEntries M, transposed_jacobian;
    for (std::size_t b = 0; b < problem.body_count(); ++b)
        M.add(problem.first_dof(b), problem.first_dof(b), problem.mass(b));
    for (std::size_t k = 0; k < problem.constraints().size(); ++k)
        for (std::size_t i = problem.first_block(k); i < problem.first_block(k + 1); ++i)
            transposed_jacobian.add(problem.first_dof(problem.body_of_block(i)), problem.constraints()[k].first_row,
                problem.jacobian(i).transpose());
    Index dofs = problem.dofs();
    for (Index row = 0; row < contact_rows; ++row) {
        const double compliance = problem.compliance()[row];
        if (compliance == 0.0) continue;
        M.add(dofs, dofs, Eigen::MatrixXd::Constant(1, 1, 1.0 / compliance));
        transposed_jacobian.add(dofs, row, Eigen::MatrixXd::Ones(1, 1));
        ++dofs;
    }
    file.M = M.matrix(dofs, dofs);
    const auto all_rows = transposed_jacobian.matrix(dofs, problem.rows());
    file.H = all_rows.leftCols(contact_rows);
    file.G = all_rows.rightCols(problem.rows() - contact_rows);
}

} // namespace

multibody::ProblemWithBodies with_bodies(const FclibProblem& file, const std::string& name)
try {
    require_space(file, name);
    auto problem = multibody::with_bodies(matrices_of(file));
    require_answers(multibody::Iterate(problem.problem), name);
    return problem;
} catch (const std::domain_error& error) {
    throw InputError(name + ": " + error.what());
}

multibody::AssembledProblem assembled(const FclibProblem& file, const std::string& name)
{
    require_space(file, name);
    multibody::AssembledProblem problem{contacts_of(file), file.W, -file.q};
    require_answers(multibody::AssembledIterate(problem), name);
    return problem;
}

FclibProblem to_fclib(const multibody::Problem& problem, const VectorXd& impulse)
{
    FclibProblem file;
    set_friction(file, contacts_in(problem));
    const Index contact_rows = file.rows_per_contact * file.contacts();
    set_matrices(file, problem, contact_rows);
    file.f = VectorXd::Zero(file.M.rows());
    for (std::size_t b = 0; b < problem.body_count(); ++b)
        problem.dofs_of(b, file.f) = problem.mass(b) * problem.dofs_of(b, problem.free_velocity());
    file.w = -problem.target().head(contact_rows);
    file.b = -problem.target().tail(problem.rows() - contact_rows);
    if (impulse.size() == 0) return file;
    FclibGuess& guess = file.guesses.emplace_back();
    guess.r = impulse.head(contact_rows);
    guess.l = impulse.tail(problem.rows() - contact_rows);
    return file;
}

} // namespace talus
