// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/wall_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

Pose shifted(const Vec3& shift)
{
    return {Eigen::Matrix3d::Identity(), shift};
}

Pose part_pose(const Translation& part, double time)
{
    return shifted(part.span.elapsed(time) * part.velocity);
}

Pose part_pose(const Turning& part, double time)
{
    return turned_about(part.point, part.axis, part.rate * part.span.elapsed(time));
}

Pose part_pose(const Shaking& part, double time)
{
    return shifted(std::sin(2.0 * std::numbers::pi * part.frequency * part.span.elapsed(time)) * part.amplitude);
}

Pose part_pose(const Course& part, double time)
{
    const auto& points = part.waypoints;
    const auto next = std::upper_bound(
        points.begin(), points.end(), time, [](double t, const Course::Waypoint& w) { return t < w.time; });
    if (next == points.begin()) return shifted(points.front().shift);
    if (next == points.end()) return shifted(points.back().shift);
    const auto& last = *(next - 1);
    const double share = (time - last.time) / (next->time - last.time);
    return shifted(last.shift + share * (next->shift - last.shift));
}

} // namespace

double MotionSpan::elapsed(double time) const
{
    return std::max(0.0, std::min(time, to) - from);
}

Pose pose_at(const WallMotion& motion, double time)
{
    Pose pose;
    for (const auto& part : motion)
        pose = std::visit([&](const auto& p) { return part_pose(p, time); }, part).after(pose);
    return pose;
}

} // namespace talus
