// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib_problem.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
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

multibody::MatrixProblem matrices_of(const FclibProblem& file)
{
    multibody::MatrixProblem p;
    p.mass = file.M;
    p.momentum = file.f;
    p.constraints = contacts_of(file);
    const Index contact_rows = file.H.cols();
    for (Index k = 0; k < file.G.cols(); ++k)
        p.constraints.push_back({.law = Law::equality, .first_row = contact_rows + k, .rows = 1});
    p.jacobian.resize(contact_rows + file.G.cols(), file.M.rows());
    p.jacobian.topRows(contact_rows) = file.H.transpose();
    if (file.G.cols() > 0) p.jacobian.bottomRows(file.G.cols()) = file.G.transpose();
    p.target.resize(p.jacobian.rows());
    p.target << -file.w, -file.b;
    p.compliance = VectorXd::Zero(p.target.size());
    return p;
}

using Entries = std::vector<Eigen::Triplet<double>>;

void add_block(Entries& entries, Index first_row, Index first_column, const Eigen::MatrixXd& block)
{
    for (Index j = 0; j < block.cols(); ++j)
        for (Index i = 0; i < block.rows(); ++i)
            if (block(i, j) != 0.0) entries.emplace_back(first_row + i, first_column + j, block(i, j));
}

Eigen::SparseMatrix<double> matrix_of(const Entries& entries, Index rows, Index columns)
{
    Eigen::SparseMatrix<double> matrix(rows, columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

void set_form(FclibProblem& file, bool rolls)
{
    file.form = rolls ? FclibForm::global_rolling : FclibForm::global;
    file.rows_per_contact = rolls ? 5 : 3;
}

void set_friction(FclibProblem& file, const std::vector<Constraint>& contacts, std::size_t stops)
{
    const auto count = static_cast<Index>(contacts.size());
    const bool rolls = file.form == FclibForm::global_rolling;
    file.mu = VectorXd::Zero(count + static_cast<Index>(stops));
    file.mu_r = VectorXd::Zero(rolls ? file.mu.size() : 0);
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

/// What a contact parts with at most, in FCLIB's words: its spring gives way by q_n − u_p at least.
struct Stop {
    Index body; ///< degree of freedom of the spring
    Index row;  ///< normal row of the contact
    double least;
};

/// The degree of freedom of the body that each row's compliance becomes; −1 where it has none.
std::vector<Index> springs_of(const multibody::Problem& problem, Index contact_rows)
{
    std::vector<Index> springs(static_cast<std::size_t>(contact_rows), -1);
    for (Index row = 0, next = problem.dofs(); row < contact_rows; ++row)
        if (problem.compliance()[row] != 0.0) springs[static_cast<std::size_t>(row)] = next++;
    return springs;
}

std::vector<Stop> stops_of(const std::vector<Constraint>& contacts, const std::vector<Index>& springs)
{
    std::vector<Stop> stops;
    for (const Constraint& contact : contacts) {
        const Index body = springs[static_cast<std::size_t>(contact.first_row)];
        if (body >= 0 && contact.headroom < 0.0) stops.push_back({body, contact.first_row, -contact.headroom});
    }
    return stops;
}

/// M with a body for each compliance, H with the stops behind the contacts, and G.
void set_matrices(FclibProblem& file, const multibody::Problem& problem, const std::vector<Index>& springs,
    const std::vector<Stop>& stops)
{
    const auto contact_rows = static_cast<Index>(springs.size());
    const Index stop_rows = file.rows_per_contact * static_cast<Index>(stops.size());
    Entries M, transposed_jacobian;
    for (std::size_t b = 0; b < problem.body_count(); ++b)
        add_block(M, problem.first_dof(b), problem.first_dof(b), problem.mass(b));
    for (std::size_t k = 0; k < problem.constraints().size(); ++k) {
        const Index row = problem.constraints()[k].first_row, column = row < contact_rows ? row : row + stop_rows;
        for (std::size_t i = problem.first_block(k); i < problem.first_block(k + 1); ++i)
            add_block(transposed_jacobian, problem.first_dof(problem.body_of_block(i)), column,
                problem.jacobian(i).transpose());
    }
    Index dofs = problem.dofs();
    for (Index row = 0; row < contact_rows; ++row) {
        const Index body = springs[static_cast<std::size_t>(row)];
        if (body < 0) continue;
        M.emplace_back(body, body, 1.0 / problem.compliance()[row]);
        transposed_jacobian.emplace_back(body, row, 1.0);
        ++dofs;
    }
    for (Index column = contact_rows; const Stop& stop : stops) {
        transposed_jacobian.emplace_back(stop.body, column, 1.0);
        column += file.rows_per_contact;
    }
    file.M = matrix_of(M, dofs, dofs);
    const auto all_rows = matrix_of(transposed_jacobian, dofs, problem.rows() + stop_rows);
    file.H = all_rows.leftCols(contact_rows + stop_rows);
    file.G = all_rows.rightCols(problem.rows() - contact_rows);
}

/// What contacts ask for, and then stops.
VectorXd offsets_of(const FclibProblem& file, const multibody::Problem& problem,
    const std::vector<Constraint>& contacts, const std::vector<Stop>& stops)
{
    VectorXd w = VectorXd::Zero(file.contact_rows());
    const Index rows = file.rows_per_contact, before = rows * static_cast<Index>(contacts.size());
    w.head(before) = -problem.target().head(before);
    for (const Constraint& contact : contacts) // one that is rigid asks for the lesser of the two
        if (problem.compliance()[contact.first_row] == 0.0) w[contact.first_row] -= std::min(0.0, contact.headroom);
    for (Index k = 0; const Stop& stop : stops) w[before + rows * k++] = -stop.least;
    return w;
}

/// λ⁰, and what the stops add to the springs' impulses.
VectorXd reactions_of(const FclibProblem& file, const std::vector<Stop>& stops, const multibody::Problem& problem,
    const VectorXd& impulse)
{
    VectorXd r = VectorXd::Zero(file.contact_rows());
    const Index before = r.size() - file.rows_per_contact * static_cast<Index>(stops.size());
    r.head(before) = impulse.head(before);
    for (Index k = 0; const Stop& stop : stops)
        r[before + file.rows_per_contact * k++] =
            std::max(0.0, stop.least / problem.compliance()[stop.row] - impulse[stop.row]);
    return r;
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
    const std::vector<Constraint> contacts = contacts_in(problem);
    set_form(file, !contacts.empty() && contacts.front().rolls());
    const Index contact_rows = file.rows_per_contact * static_cast<Index>(contacts.size());
    const std::vector<Index> springs = springs_of(problem, contact_rows);
    const std::vector<Stop> stops = stops_of(contacts, springs);
    set_matrices(file, problem, springs, stops);
    set_friction(file, contacts, stops.size());
    file.f = VectorXd::Zero(file.M.rows());
    for (std::size_t b = 0; b < problem.body_count(); ++b)
        problem.dofs_of(b, file.f) = problem.mass(b) * problem.dofs_of(b, problem.free_velocity());
    file.w = offsets_of(file, problem, contacts, stops);
    file.b = -problem.target().tail(problem.rows() - contact_rows);
    if (impulse.size() == 0) return file;
    FclibGuess& guess = file.guesses.emplace_back();
    guess.r = reactions_of(file, stops, problem, impulse);
    guess.l = impulse.tail(problem.rows() - contact_rows);
    return file;
}

} // namespace talus
