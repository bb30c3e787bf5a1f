// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/problem.hpp"

#include <Eigen/LU>

#include <cassert>

namespace talus::multibody
{
namespace
{

void append(std::vector<double>& vector, const Eigen::VectorXd& more)
{
    vector.insert(vector.end(), more.begin(), more.end());
}

} // namespace

std::size_t Problem::add_body(const Eigen::MatrixXd& mass, const Eigen::VectorXd& momentum)
{
    const auto decomposition = mass.partialPivLu(); // as it is: in files from outside symmetric to three digits only
    first_dof_.push_back(dofs());
    mass_.add(mass);
    inverse_mass_.add(decomposition.solve(Eigen::MatrixXd::Identity(mass.rows(), mass.cols())));
    append(free_velocity_, decomposition.solve(momentum));
    return body_count() - 1;
}

std::size_t Problem::add_constraint(Constraint constraint, const std::vector<BodyRows>& bodies,
    const Eigen::VectorXd& compliance, const Eigen::VectorXd& target)
{
    constraint.first_row = rows();
    constraint.rows = target.size();
    assert(constraint.law != Law::contact || constraint.rows == 1 + tangent_rows || constraint.rolls());
    constraints_.push_back(constraint);
    append(compliance_, compliance);
    append(target_, target);
    for (const auto& [body, jacobian] : bodies) {
        body_of_block_.push_back(body);
        jacobian_.add(jacobian);
        response_.add(inverse_mass_[body] * jacobian.transpose());
    }
    first_block_.push_back(body_of_block_.size());
    return constraints_.size() - 1;
}

Eigen::MatrixXd Problem::diagonal_block(std::size_t k) const
{
    Eigen::MatrixXd D = rows_of(k, compliance()).asDiagonal();
    for (std::size_t i = first_block(k); i < first_block(k + 1); ++i) D += jacobian(i) * response(i);
    return D;
}

} // namespace talus::multibody
