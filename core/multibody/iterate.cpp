// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/iterate.hpp"

namespace talus::multibody
{

Iterate::Iterate(const Problem& problem)
    : problem_(&problem), velocity_(problem.free_velocity()), impulse_(Eigen::VectorXd::Zero(problem.rows()))
{
}

Iterate::Iterate(const Problem& problem, const Eigen::VectorXd& impulse) : Iterate(problem)
{
    for (std::size_t k = 0; k < constraints().size(); ++k) add(k, problem.rows_of(k, impulse));
}

void Iterate::residual_of(std::size_t k, Eigen::Ref<Eigen::VectorXd> y) const
{
    const Problem& p = *problem_;
    y = p.rows_of(k, p.compliance()).cwiseProduct(p.rows_of(k, impulse_)) - p.rows_of(k, p.target());
    for (std::size_t i = p.first_block(k); i < p.first_block(k + 1); ++i)
        y += p.jacobian(i).lazyProduct(p.dofs_of(p.body_of_block(i), velocity_));
}

void Iterate::add(std::size_t k, const Eigen::Ref<const Eigen::VectorXd>& change)
{
    const Problem& p = *problem_;
    p.rows_of(k, impulse_) += change;
    for (std::size_t i = p.first_block(k); i < p.first_block(k + 1); ++i)
        p.dofs_of(p.body_of_block(i), velocity_) += p.response(i).lazyProduct(change);
}

} // namespace talus::multibody
