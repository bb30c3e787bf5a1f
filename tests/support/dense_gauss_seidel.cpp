// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dense_gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

namespace talus::test
{
namespace
{

using Eigen::Index;
constexpr Index contact_rows = 3; ///< normal, tangent, tangent
constexpr Index rolling_rows = 2;

Index first_row(std::size_t contact)
{
    return DenseProblem::rows * static_cast<Index>(contact);
}

/// Normal and two tangents as columns.
Eigen::Matrix3d contact_basis(const Vec3& normal)
{
    Eigen::Matrix3d basis;
    basis.col(0) = normal;
    basis.col(1) = normal.unitOrthogonal();
    basis.col(2) = normal.cross(basis.col(1));
    return basis;
}

/// Writes what one body contributes to a contact's rows: direction·(v + ω × arm), and axis·ω for the rolling rows.
void fill_rows(
    Eigen::MatrixXd& jacobian, Index row, std::size_t body, const Vec3& arm, const Eigen::Matrix3d& basis, double sign)
{
    const Index column = 6 * static_cast<Index>(body);
    for (Index i = 0; i < contact_rows; ++i) {
        const Vec3 direction = basis.col(i);
        jacobian.block<1, 3>(row + i, column) = sign * direction.transpose();
        jacobian.block<1, 3>(row + i, column + 3) = sign * arm.cross(direction).transpose();
    }
    for (Index i = 0; i < rolling_rows; ++i)
        jacobian.block<1, 3>(row + contact_rows + i, column + 3) = sign * basis.col(1 + i).transpose();
}

void add_contact(DenseProblem& p, const State& state, const DenseContact& contact, std::size_t k)
{
    const Index row = first_row(k);
    const Eigen::Matrix3d basis = contact_basis(contact.normal);
    double scale = 1.0;
    if (!contact.with_wall) {
        const double distance = (state.position[contact.a] - state.position[contact.b]).norm();
        scale = distance / (state.radius[contact.a] + state.radius[contact.b]);
        fill_rows(p.jacobian, row, contact.b, scale * state.radius[contact.b] * contact.normal, basis, -1.0);
    }
    fill_rows(p.jacobian, row, contact.a, -scale * state.radius[contact.a] * contact.normal, basis, 1.0);
    p.target[row] = contact.target;
    p.drift.segment<contact_rows>(row) = basis.transpose() * contact.wall_velocity;
    p.drift.segment<rolling_rows>(row + contact_rows) = basis.rightCols<rolling_rows>().transpose() * contact.wall_spin;
    p.compliance[row] = contact.compliance;
    p.impulse.segment<contact_rows>(row) = basis.transpose() * contact.impulse;
    p.impulse.segment<rolling_rows>(row + contact_rows) =
        basis.rightCols<rolling_rows>().transpose() * contact.rolling_impulse;
    p.basis.push_back(basis);
    p.friction.push_back(contact.friction);
    p.rolling_reach.push_back(contact.rolling_reach);
    p.coupled.push_back(false);
}

/// A piston as the body of this number: v⁽¹⁾, mass and inertia.
void add_piston_body(
    DenseProblem& p, std::size_t body, const Piston& piston, const PistonState& own, const Model& model, double time)
{
    const Index column = 6 * static_cast<Index>(body);
    p.inverse_mass.segment<3>(column).setConstant(1.0 / piston.mass);
    p.inverse_mass.segment<3>(column + 3) = piston.inertia.diagonal().cwiseInverse();
    p.velocity.segment<3>(column) =
        own.velocity + model.time_step * (model.gravity + piston.load_at(time) / piston.mass * piston.guide);
    p.velocity.segment<3>(column + 3) = own.spin;
}

/// The rows that a guide leaves to no motion, with what eq. (2) asks of them.
void add_guide_rows(
    DenseProblem& p, Index row, std::size_t body, const Piston& piston, const PistonState& own, double h)
{
    constexpr double upsilon = 1.0 / 9.0;
    const Index column = 6 * static_cast<Index>(body);
    const Vec3 across = any_perpendicular(piston.guide);
    p.jacobian.block<1, 3>(row, column) = across.transpose();
    p.jacobian.block<1, 3>(row + 1, column) = piston.guide.cross(across).transpose();
    p.jacobian.block<3, 3>(row + 2, column + 3).setIdentity();
    const Vec3 way = own.pose(piston.center) - piston.center;
    p.target.segment<DenseProblem::guide_rows>(row).setZero();
    for (Index i = 0; i < 2; ++i) {
        const Vec3 direction = p.jacobian.block<1, 3>(row + i, column).transpose();
        p.target[row + i] = upsilon * (direction.dot(own.velocity) - 4.0 / h * direction.dot(way));
    }
    p.impulse.segment<DenseProblem::guide_rows>(row) = own.guide_impulse.head<DenseProblem::guide_rows>();
}

/// The vector cut back to this length.
Eigen::VectorXd on_disk(const Eigen::VectorXd& vector, double radius)
{
    const double length = vector.norm();
    return length > radius ? Eigen::VectorXd(vector * (radius / length)) : vector;
}

/// −D_kk⁻¹ r of the rows [row, row + size): the change that would solve them as equations.
Eigen::VectorXd unconstrained_change(const DenseProblem& p, Index row, Index size)
{
    const Eigen::MatrixXd G = p.jacobian.middleRows(row, size);
    const Eigen::VectorXd sigma = p.compliance.segment(row, size);
    const Eigen::MatrixXd D = G * p.inverse_mass.asDiagonal() * G.transpose() + Eigen::MatrixXd(sigma.asDiagonal());
    const Eigen::VectorXd lambda = p.impulse.segment(row, size);
    const Eigen::VectorXd r =
        G * p.velocity - p.drift.segment(row, size) + sigma.cwiseProduct(lambda) - p.target.segment(row, size);
    return -D.inverse() * r;
}

/// The minimum of ½ zᵀ D z + bᵀ z on a disk, by plain projected descent.
Eigen::VectorXd minimum_on_disk(const Eigen::MatrixXd& D, const Eigen::VectorXd& b, double radius)
{
    Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());
    for (int step = 0; step < 3000; ++step) z = on_disk(z - (D * z + b) / D.trace(), radius);
    return z;
}

/// y_k of some rows of a contact, and their block of D.
struct Rows {
    Eigen::MatrixXd D;
    Eigen::VectorXd y;

    Rows(const DenseProblem& p, Index row, Index size)
    {
        const Eigen::MatrixXd G = p.jacobian.middleRows(row, size);
        const Eigen::VectorXd sigma = p.compliance.segment(row, size);
        D = G * p.inverse_mass.asDiagonal() * G.transpose() + Eigen::MatrixXd(sigma.asDiagonal());
        y = G * p.velocity + sigma.cwiseProduct(p.impulse.segment(row, size)) - p.target.segment(row, size);
    }
};

/// Normal first, then the tangent with the change of the normal, on the disk of the new one.
Eigen::VectorXd solved_coupled_contact(const DenseProblem& p, std::size_t k)
{
    const Index row = first_row(k);
    Rows rows(p, row, contact_rows);
    Eigen::VectorXd z = p.impulse.segment(row, contact_rows);
    const double normal = std::max(0.0, z[0] - rows.y[0] / rows.D(0, 0));
    rows.y += rows.D.col(0) * (normal - z[0]);
    z[0] = normal;
    const Eigen::MatrixXd D = rows.D.bottomRightCorner(2, 2);
    const Eigen::VectorXd b = rows.y.tail(2) - D * z.tail(2);
    z.tail(2) = minimum_on_disk(D, b, p.friction[k] * normal);
    return z;
}

Eigen::VectorXd solved_contact(const DenseProblem& p, std::size_t k, double relaxation = 1.0)
{
    if (p.coupled[k]) return solved_coupled_contact(p, k);
    const Index row = first_row(k);
    Eigen::VectorXd z = p.impulse.segment(row, contact_rows) + relaxation * unconstrained_change(p, row, contact_rows);
    if (z[0] <= 0.0) return Eigen::VectorXd::Zero(contact_rows);
    z.tail(2) = on_disk(z.tail(2), p.friction[k] * z[0]);
    return z;
}

Eigen::VectorXd solved_rolling(const DenseProblem& p, std::size_t k, double relaxation = 1.0)
{
    const Index row = first_row(k) + contact_rows;
    if (p.rolling_reach[k] == 0.0) return Eigen::VectorXd::Zero(rolling_rows);
    if (p.coupled[k]) {
        const Rows rows(p, row, rolling_rows);
        const Eigen::VectorXd b = rows.y - rows.D * p.impulse.segment(row, rolling_rows);
        return minimum_on_disk(rows.D, b, p.rolling_reach[k] * p.impulse[first_row(k)]);
    }
    const Eigen::VectorXd z =
        p.impulse.segment(row, rolling_rows) + relaxation * unconstrained_change(p, row, rolling_rows);
    return on_disk(z, p.rolling_reach[k] * p.impulse[first_row(k)]);
}

void apply(DenseProblem& p, Index row, const Eigen::VectorXd& solved)
{
    const Eigen::VectorXd change = solved - p.impulse.segment(row, solved.size());
    p.impulse.segment(row, solved.size()) = solved;
    p.velocity += p.inverse_mass.asDiagonal() * (p.jacobian.middleRows(row, solved.size()).transpose() * change);
}

/// G M⁻¹ Gᵀ of one row.
double inverse_effective_mass(const DenseProblem& p, Index row)
{
    return p.jacobian.row(row) * p.inverse_mass.asDiagonal() * p.jacobian.row(row).transpose();
}

/// Σ W|λ|² over all rows.
double weighted_square(const DenseProblem& p, const Eigen::VectorXd& impulse)
{
    double sum = 0.0;
    for (Index row = 0; row < impulse.size(); row += DenseProblem::rows) {
        sum += inverse_effective_mass(p, row) * impulse.segment(row, contact_rows).squaredNorm();
        sum += inverse_effective_mass(p, row + contact_rows) *
               impulse.segment(row + contact_rows, rolling_rows).squaredNorm();
    }
    return sum;
}

} // namespace

Vec3 DenseProblem::impulse_in_space(std::size_t k) const
{
    return basis[k] * impulse.segment<contact_rows>(first_row(k));
}

Vec3 DenseProblem::rolling_impulse_in_space(std::size_t k) const
{
    return basis[k].rightCols<rolling_rows>() * impulse.segment<rolling_rows>(first_row(k) + contact_rows);
}

DenseProblem make_dense_problem(const State& state, const std::vector<DenseContact>& contacts, bool spin)
{
    DenseProblem p;
    const auto columns = 6 * static_cast<Index>(state.count());
    const auto all_rows = DenseProblem::rows * static_cast<Index>(contacts.size());
    p.inverse_mass.resize(columns);
    p.velocity.resize(columns);
    for (std::size_t i = 0; i < state.count(); ++i) {
        const double inertia = 0.4 * state.mass(i) * state.radius[i] * state.radius[i];
        p.inverse_mass.segment<3>(6 * static_cast<Index>(i)).setConstant(1.0 / state.mass(i));
        p.inverse_mass.segment<3>(6 * static_cast<Index>(i) + 3).setConstant(spin ? 1.0 / inertia : 0.0);
        p.velocity.segment<3>(6 * static_cast<Index>(i)) = state.body(i).velocity;
        p.velocity.segment<3>(6 * static_cast<Index>(i) + 3) = state.angular_velocity(i);
    }
    p.jacobian = Eigen::MatrixXd::Zero(all_rows, columns);
    p.compliance = p.target = p.drift = p.impulse = Eigen::VectorXd::Zero(all_rows);
    for (std::size_t k = 0; k < contacts.size(); ++k) add_contact(p, state, contacts[k], k);
    return p;
}

void add_pistons(DenseProblem& p, const State& state, const Model& model, const std::vector<DenseContact>& contacts)
{
    const Index rows = p.target.size(), columns = p.velocity.size();
    const auto pistons = static_cast<Index>(model.pistons.size());
    const Index more_rows = DenseProblem::guide_rows * pistons, more_columns = 6 * pistons;
    p.jacobian.conservativeResizeLike(Eigen::MatrixXd::Zero(rows + more_rows, columns + more_columns));
    for (auto* vector : {&p.compliance, &p.target, &p.drift, &p.impulse})
        vector->conservativeResizeLike(Eigen::VectorXd::Zero(rows + more_rows));
    for (auto* vector : {&p.inverse_mass, &p.velocity})
        vector->conservativeResizeLike(Eigen::VectorXd::Zero(columns + more_columns));
    for (std::size_t k = 0; k < model.pistons.size(); ++k) {
        const std::size_t body = state.count() + k;
        add_piston_body(p, body, model.pistons[k], state.pistons[k], model, state.time);
        add_guide_rows(p, rows + DenseProblem::guide_rows * static_cast<Index>(k), body, model.pistons[k],
            state.pistons[k], model.time_step);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        if (contacts[k].piston < 0) continue;
        fill_rows(p.jacobian, first_row(k), state.count() + static_cast<std::size_t>(contacts[k].piston),
            contacts[k].piston_arm, p.basis[k], -1.0);
        p.coupled[k] = true;
    }
}

void warm_start(DenseProblem& p)
{
    p.velocity += p.inverse_mass.asDiagonal() * (p.jacobian.transpose() * p.impulse);
}

void sweep(DenseProblem& p, double relaxation)
{
    for (std::size_t k = 0; k < p.friction.size(); ++k) {
        apply(p, first_row(k), solved_contact(p, k, relaxation));
        apply(p, first_row(k) + contact_rows, solved_rolling(p, k, relaxation));
    }
    constexpr Index size = DenseProblem::guide_rows;
    for (Index row = first_row(p.friction.size()); row < p.target.size(); row += size)
        apply(p, row, p.impulse.segment(row, size) + unconstrained_change(p, row, size));
}

double residual(const DenseProblem& p)
{
    Eigen::VectorXd change(p.impulse.size());
    for (std::size_t k = 0; k < p.friction.size(); ++k)
        change.segment(first_row(k), DenseProblem::rows) << solved_contact(p, k), solved_rolling(p, k);
    const Eigen::VectorXd solved = change;
    change -= p.impulse;
    return std::sqrt(weighted_square(p, change) / weighted_square(p, solved));
}

} // namespace talus::test
