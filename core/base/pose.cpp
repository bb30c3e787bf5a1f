// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/pose.hpp"

#include <cmath>

namespace talus
{

Pose turned_about(const Vec3& point, const Vec3& axis, double angle)
{
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    return {rotation, point - rotation * point};
}

Twist twist_between(const Pose& from, const Pose& to, double h)
{
    const Pose change = to.after(from.inverse());
    const Eigen::AngleAxisd turn(change.rotation);
    const Vec3 w = turn.angle() * turn.axis();
    const double angle = turn.angle();
    // V⁻¹ = 1 − ½ [w] + c [w]², c = 1/θ² − (1 + cos θ)/(2 θ sin θ), which is 1/12 in the limit.
    const double c =
        angle < 1e-3 ? 1.0 / 12.0 : 1.0 / (angle * angle) - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
    const Vec3 first = w.cross(change.shift);
    return {(change.shift - 0.5 * first + c * w.cross(first)) / h, w / h};
}

Box placed(const Pose& pose, const Box& box)
{
    const Vec3 center = pose(box.center());
    const Vec3 half = 0.5 * (pose.rotation.cwiseAbs() * box.extent());
    return {center - half, center + half};
}

} // namespace talus
