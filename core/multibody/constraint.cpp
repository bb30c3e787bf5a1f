// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/constraint.hpp"

#include "core/law/coulomb.hpp"

#include <algorithm>
#include <cmath>

namespace talus::multibody
{
namespace
{

void project_on_disk(Eigen::Ref<Eigen::VectorXd> part, double radius)
{
    Eigen::Vector2d vector = part;
    cut_to_disk<double>(vector, radius);
    part = vector;
}

double beyond_disk(const Eigen::Ref<const Eigen::VectorXd>& part, double radius)
{
    return talus::beyond_disk<double>(Eigen::Vector2d(part), radius);
}

} // namespace

void limit_parting(const Constraint& constraint, double normal_impulse, double diagonal, Eigen::Ref<Eigen::VectorXd> y)
{
    const double rigid = diagonal - constraint.compliance;
    if (constraint.law != Law::contact || !std::isfinite(constraint.headroom) || rigid <= 0.0) return;
    const double excess = y[0] - constraint.compliance * normal_impulse - constraint.headroom;
    y[0] = std::max(y[0], excess * diagonal / rigid);
}

void project(const Constraint& constraint, Eigen::Ref<Eigen::VectorXd> impulse)
{
    if (constraint.law == Law::unilateral) impulse = impulse.cwiseMax(0.0);
    if (constraint.law != Law::contact) return;
    impulse[0] = std::max(impulse[0], 0.0);
    project_on_disk(impulse.segment<tangent_rows>(1), constraint.friction * impulse[0]);
    if (constraint.rolls())
        project_on_disk(impulse.segment<rolling_rows>(1 + tangent_rows), constraint.rolling_reach * impulse[0]);
    if (constraint.twists()) {
        const double most = constraint.twisting_reach * impulse[0];
        impulse[twisting_row] = std::clamp(impulse[twisting_row], -most, most);
    }
}

double cone_violation(const Constraint& constraint, const Eigen::Ref<const Eigen::VectorXd>& impulse)
{
    switch (constraint.law) {
    case Law::equality:
        return 0.0;
    case Law::unilateral:
        return std::max(0.0, -impulse.minCoeff());
    case Law::contact:
        break;
    }
    double worst = std::max(0.0, -impulse[0]);
    worst = std::max(worst, beyond_disk(impulse.segment<tangent_rows>(1), constraint.friction * impulse[0]));
    if (constraint.rolls())
        worst = std::max(
            worst, beyond_disk(impulse.segment<rolling_rows>(1 + tangent_rows), constraint.rolling_reach * impulse[0]));
    if (constraint.twists())
        worst = std::max(worst, std::abs(impulse[twisting_row]) - constraint.twisting_reach * impulse[0]);
    return worst;
}

} // namespace talus::multibody
