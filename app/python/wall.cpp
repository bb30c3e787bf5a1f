// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/python/wall.hpp"

#include "scenarios/builder/checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace talus::python
{
namespace
{

/// The place of a shape that `position` follows.
Vec3 middle_of(const Shape& shape)
{
    if (const auto* plane = std::get_if<Plane>(&shape)) return plane->point;
    return bounds(shape).center();
}

} // namespace

WallHandle::WallHandle(std::shared_ptr<Session> session, const std::string& name)
    : session_(std::move(session)), index_(0)
{
    const auto names = names_of(session_->now().model.walls);
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw std::out_of_range(fmt::format("there is no wall '{}'; there is {}", name, fmt::join(names, ", ")));
    index_ = static_cast<std::size_t>(found - names.begin());
}

WallLoad WallHandle::last_load() const
{
    const double h = session_->now().model.time_step;
    const auto& loads = session_->report().wall_loads;
    if (loads.empty()) return {}; // before the first step
    return {loads[index_].impulse / h, loads[index_].torque / h};
}

Vec3 WallHandle::force() const
{
    return last_load().impulse;
}

Vec3 WallHandle::torque() const
{
    return last_load().torque;
}

PlacedWall WallHandle::placed() const
{
    const Simulation& simulation = session_->now();
    return place_walls(simulation.model, simulation.state, simulation.model.time_step)[index_];
}

Vec3 WallHandle::position() const
{
    return placed().pose()(middle_of(wall().shape));
}

Vec3 WallHandle::velocity() const
{
    const PlacedWall here = placed();
    return here.velocity(0, here.pose()(middle_of(wall().shape)));
}

std::size_t WallHandle::piston() const
{
    if (!wall().is_piston())
        throw std::invalid_argument(
            fmt::format("the wall '{}' has no load: give it a 'mass' and a 'guide' in the scene", name()));
    return static_cast<std::size_t>(wall().piston);
}

double WallHandle::load() const
{
    const Simulation& simulation = session_->now();
    return simulation.model.pistons[piston()].load_at(simulation.state.time);
}

void WallHandle::set_velocity(const Vec3& velocity)
{
    if (wall().is_piston())
        throw std::invalid_argument(
            fmt::format("the wall '{}' has a finite mass and moves as forces have it: set its load", name()));
    drive_wall(session_->change(), index_, velocity);
}

void WallHandle::set_load(double force)
{
    if (!std::isfinite(force)) throw std::invalid_argument("a load must be a finite number");
    load_piston(session_->change(), piston(), force);
}

} // namespace talus::python
