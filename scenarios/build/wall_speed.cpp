// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/wall_speed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

bool goes_on(const MotionSpan& span, double time)
{
    return span.from <= time && time < span.to;
}

/// The arm on which a part turns the farthest corner of a box [m]; none where it does not turn.
double longest_arm(const MotionPart& part, const Box& box)
{
    const auto* turning = std::get_if<Turning>(&part);
    double arm = 0.0;
    if (turning)
        for (const Vec3& x : box.corners()) arm = std::max(arm, turning->axis.cross(x - turning->point).norm());
    return arm;
}

double speed_at(const Translation& part, double time, double)
{
    return goes_on(part.span, time) ? part.velocity.norm() : 0.0;
}

double speed_at(const Turning& part, double time, double arm)
{
    return goes_on(part.span, time) ? std::abs(part.rate) * arm : 0.0;
}

double speed_at(const Shaking& part, double time, double)
{
    return goes_on(part.span, time) ? 2.0 * std::numbers::pi * part.frequency * part.amplitude.norm() : 0.0;
}

double speed_at(const Course& part, double time, double)
{
    const auto& points = part.waypoints;
    for (std::size_t k = 1; k < points.size(); ++k)
        if (points[k - 1].time <= time && time < points[k].time)
            return (points[k].shift - points[k - 1].shift).norm() / (points[k].time - points[k - 1].time);
    return 0.0;
}

/// How far from where they were a part brings points, until a time [m].
double farthest_by(const Translation& part, double time, double)
{
    return part.span.elapsed(time) * part.velocity.norm();
}

double farthest_by(const Turning&, double, double arm)
{
    return 2.0 * arm;
}

double farthest_by(const Shaking& part, double, double)
{
    return part.amplitude.norm();
}

double farthest_by(const Course& part, double, double)
{
    double farthest = 0.0;
    for (const auto& waypoint : part.waypoints) farthest = std::max(farthest, waypoint.shift.norm());
    return farthest;
}

/// When parts, or lines of a table, begin: between two of these times no wall becomes faster.
std::vector<double> beginnings(const WallMotion& motion)
{
    std::vector<double> times;
    const auto add = [&](const auto& part) {
        if constexpr (requires { part.waypoints; })
            for (const auto& waypoint : part.waypoints) times.push_back(waypoint.time);
        else
            times.push_back(part.span.from);
    };
    for (const auto& part : motion) std::visit(add, part);
    return times;
}

double fastest_point(const WallMotion& motion, const Box& box, double duration)
{
    double fastest = 0.0;
    for (const double time : beginnings(motion)) {
        double speed = 0.0, shift = 0.0;
        for (const auto& part : motion) {
            const double arm = longest_arm(part, box) + shift;
            speed += std::visit([&](const auto& p) { return speed_at(p, time, arm); }, part);
            shift += std::visit([&](const auto& p) { return farthest_by(p, duration, arm); }, part);
        }
        fastest = std::max(fastest, speed);
    }
    return fastest;
}

} // namespace

double fastest_wall(const Simulation& simulation)
{
    Box spheres;
    for (const Vec3& x : simulation.state.position) spheres.extend(x);
    for (const auto& pour : simulation.pours) spheres.extend(pour.region.bounds());
    double fastest = 0.0;
    for (const auto& wall : simulation.model.walls) {
        // A plane is looked at where the spheres are, any other wall at the corners of its box.
        const Box own = bounds(wall.shape);
        if (const Box& box = own.empty() ? spheres : own; !box.empty())
            fastest = std::max(fastest, fastest_point(wall.motion, box, simulation.duration));
    }
    return fastest;
}

} // namespace talus
