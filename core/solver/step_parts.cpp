// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/step_parts.hpp"

#include "core/multibody/stepping.hpp"

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using multibody::Law;
using multibody::Problem;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, 6>; ///< of a body with six degrees of freedom

/// τ/h of the guides: critical damping, as for the contacts (upsilon of law.hpp).
constexpr double guide_relaxation = 2.0;

/// The axis of a rolling row, a tangent, or of the twisting row, the normal.
auto rolling_axis(const Eigen::Matrix3d& basis, Index row)
{
    return basis.col(row == multibody::twisting_row ? 0 : row - multibody::rolling_rows);
}

} // namespace

Index rows_of_contact(const ModelledPhysics& physics)
{
    return contact_rows + (physics.rolling ? multibody::rolling_rows : 0) + (physics.twisting ? 1 : 0);
}

Eigen::Matrix3d contact_basis(const Vec3& normal)
{
    Eigen::Matrix3d basis;
    basis.col(0) = normal;
    basis.col(1) = any_perpendicular(normal);
    basis.col(2) = normal.cross(basis.col(1));
    return basis;
}

VectorXd in_rows(const Eigen::Matrix3d& basis, Index rows, const Vec3& vector, const Vec3& rolling)
{
    VectorXd both(rows);
    both.head<contact_rows>() = basis.transpose() * vector;
    for (Index row = contact_rows; row < rows; ++row) both[row] = rolling_axis(basis, row).dot(rolling);
    return both;
}

void add_sphere_body(Problem& problem, const Body& body, bool spin, const Vec3& gain)
{
    VectorXd mass = VectorXd::Constant(spin ? 6 : 3, 1.0 / body.inverse_mass), velocity(mass.size());
    velocity.head<3>() = body.velocity + gain;
    if (spin) {
        mass.tail<3>() /= inverse_inertia_factor;
        velocity.tail<3>() = body.rim_velocity;
    }
    problem.add_body(mass.asDiagonal(), mass.cwiseProduct(velocity));
}

MatrixXd sphere_rows(
    const Eigen::Matrix3d& basis, Index rows, const Body& body, bool spin, double sign, double arm_scale)
{
    RowMatrix G = RowMatrix::Zero(rows, 6);
    G.topLeftCorner<contact_rows, 3>() = sign * basis.transpose();
    for (Index row = 0; row < contact_rows; ++row)
        G.block<1, 3>(row, 3) = arm_scale * basis.col(row).cross(basis.col(0)).transpose();
    for (Index row = contact_rows; row < rows; ++row)
        G.block<1, 3>(row, 3) = sign / body.spin_radius * rolling_axis(basis, row).transpose();
    return G.leftCols(spin ? 6 : 3);
}

void add_contact(Problem& problem, const TileContacts& contacts, std::size_t k, const Eigen::Matrix3d& basis,
    Index rows, const std::vector<multibody::BodyRows>& bodies)
{
    const Contact c = contacts.contact(k);
    const RollingRow rolling = contacts.has_rolling() ? contacts.rolling(k) : RollingRow{};
    VectorXd compliance = VectorXd::Zero(rows), target = VectorXd::Zero(rows);
    compliance[0] = c.compliance;
    if (contacts.has_moving_walls()) target = in_rows(basis, rows, contacts.wall(k).velocity, contacts.wall(k).spin);
    target[0] += c.target;
    problem.add_constraint({.law = Law::contact,
                               .friction = c.friction,
                               .headroom = c.parting - c.target,
                               .compliance = c.compliance,
                               .rolling_reach = rolling.reach,
                               .twisting_reach = rolling.twist_reach},
        bodies, compliance, target);
}

Vec3 rolling_in_space(const Eigen::Matrix3d& basis, const Eigen::Ref<const VectorXd>& impulse)
{
    Vec3 sum = Vec3::Zero();
    for (Index row = contact_rows; row < impulse.size(); ++row) sum += impulse[row] * rolling_axis(basis, row);
    return sum;
}

VectorXd impulse_in_rows(const TileContacts& contacts, std::size_t k, const Eigen::Matrix3d& basis, Index rows)
{
    const Vec3 rolling = contacts.has_rolling() ? contacts.rolling_impulse(k) : Vec3::Zero().eval();
    return in_rows(basis, rows, contacts.impulse(k), rolling);
}

void add_piston_body(Problem& problem, const Piston& piston, const PistonState& own, const Vec3& gravity,
    const WallLoad& attraction, double h, double time)
{
    const Eigen::Matrix3d inertia = own.pose.rotation * piston.inertia * own.pose.rotation.transpose();
    MatrixXd mass = MatrixXd::Zero(6, 6);
    mass.topLeftCorner<3, 3>().diagonal().setConstant(piston.mass);
    mass.bottomRightCorner<3, 3>() = inertia;
    const Vec3 force = piston.mass * gravity + piston.load_at(time) * piston.guide;
    VectorXd momentum(6);
    momentum << piston.mass * own.velocity + h * force + attraction.impulse, inertia * own.spin + attraction.torque;
    problem.add_body(mass, momentum);
}

MatrixXd piston_rows(const Eigen::Matrix3d& basis, Index rows, const Vec3& arm)
{
    RowMatrix G = RowMatrix::Zero(rows, 6);
    G.topLeftCorner<contact_rows, 3>() = -basis.transpose();
    for (Index row = 0; row < contact_rows; ++row) G.block<1, 3>(row, 3) = -arm.cross(basis.col(row)).transpose();
    for (Index row = contact_rows; row < rows; ++row) G.block<1, 3>(row, 3) = -rolling_axis(basis, row).transpose();
    return G;
}

void add_guide(Problem& problem, std::size_t body, const Piston& piston, const PistonState& own, double h, double time)
{
    const bool held = !piston.is_free(time);
    RowMatrix G = RowMatrix::Zero(held ? 6 : 5, 6);
    const Vec3 across = any_perpendicular(piston.guide);
    G.block<1, 3>(0, 0) = across.transpose();
    G.block<1, 3>(1, 0) = piston.guide.cross(across).transpose();
    G.block<3, 3>(2, 3).setIdentity();
    if (held) G.block<1, 3>(5, 0) = piston.guide.transpose();

    const Eigen::AngleAxisd turn(own.pose.rotation);
    PistonState::GuideVector displacement, velocity;
    displacement << own.pose(piston.center) - piston.center, turn.angle() * turn.axis();
    velocity << own.velocity, own.spin;
    const VectorXd gap = G * displacement, speed = G * velocity;
    VectorXd target(G.rows());
    for (Index row = 0; row < G.rows(); ++row)
        target[row] = multibody::holonomic_row(gap[row], speed[row], infinity, guide_relaxation * h, h).target;
    problem.add_constraint({.law = Law::equality}, {{body, G}}, VectorXd::Zero(G.rows()), target);
}

} // namespace talus
