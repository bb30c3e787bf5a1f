// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/piston.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{

double Piston::load_at(double time) const
{
    if (load.empty()) return 0.0;
    const auto next =
        std::upper_bound(load.begin(), load.end(), time, [](double t, const LoadPoint& p) { return t < p.time; });
    if (next == load.begin()) return load.front().force;
    if (next == load.end()) return load.back().force;
    const LoadPoint& last = *(next - 1);
    return last.force + (time - last.time) / (next->time - last.time) * (next->force - last.force);
}

double Piston::most_force(const Vec3& gravity) const
{
    double most = 0.0;
    for (const LoadPoint& point : load) most = std::max(most, std::abs(point.force));
    return most + mass * std::abs(guide.dot(gravity));
}

Vec3 Piston::free_gain(const Vec3& gravity, double time, double step) const
{
    if (!is_free(time)) return Vec3::Zero();
    return step * (gravity.dot(guide) + load_at(time) / mass) * guide;
}

Eigen::Matrix3d block_inertia(double mass, const Vec3& extent)
{
    const Vec3 squares = extent.cwiseAbs2();
    return (mass / 12.0 * (Vec3::Constant(squares.sum()) - squares)).asDiagonal();
}

Twist twist_of(const Piston& piston, const PistonState& state)
{
    return {state.velocity - state.spin.cross(state.pose(piston.center)), state.spin};
}

double travel(const Piston& piston, const PistonState& state)
{
    return piston.guide.dot(state.pose(piston.center) - piston.center);
}

double travel_speed(const Piston& piston, const PistonState& state)
{
    return piston.guide.dot(state.velocity);
}

double kinetic_energy(const Piston& piston, const PistonState& state)
{
    const Vec3 own_spin = state.pose.rotation.transpose() * state.spin;
    return 0.5 * (piston.mass * state.velocity.squaredNorm() + own_spin.dot(piston.inertia * own_spin));
}

void move(const Piston& piston, PistonState& state, double step)
{
    const Vec3 center = state.pose(piston.center) + step * state.velocity;
    const double angle = step * state.spin.norm();
    if (angle > 0.0) state.pose.rotation = Eigen::AngleAxisd(angle, state.spin.normalized()) * state.pose.rotation;
    state.pose.shift = center - state.pose.rotation * piston.center;
}

} // namespace talus
