// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/wall_force.hpp"

#include <cassert>
#include <limits>

namespace talus
{
namespace
{

constexpr std::array<const char*, 6> force_names = {
    "force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"};

const char* unit_of(std::size_t k)
{
    return k < 3 ? "N" : "N m";
}

} // namespace

WallForce::WallForce(std::string sensor_name, std::size_t wall, const Vec3& point, const TimeWindow& window)
    : Sensor(std::move(sensor_name)), wall_(wall), point_(point), window_(window)
{
    latest_.fill(std::numeric_limits<double>::quiet_NaN());
}

void WallForce::watch(const Snapshot& now)
{
    assert(wall_ < now.report.wall_loads.size());
    const WallLoad& load = now.report.wall_loads[wall_];
    const double h = now.model.time_step;
    if (!now.model.walls[wall_].stands_at(now.state.time - 0.5 * h)) return; // what is not there bears nothing
    const Vec3 force = load.impulse / h;
    const Vec3 torque = load.torque / h - point_.cross(force);
    const Load both = {force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z()};
    for (std::size_t k = 0; k < quantities; ++k) {
        sum_[k] += both[k];
        if (window_.contains(now.state.time)) means_[k].add(both[k]);
    }
    ++steps_;
}

void WallForce::sample(const Snapshot& now)
{
    if (!now.model.walls[wall_].stands_at(now.state.time)) latest_.fill(std::numeric_limits<double>::quiet_NaN());
    if (steps_ == 0) return;
    for (std::size_t k = 0; k < quantities; ++k) latest_[k] = sum_[k] / static_cast<double>(steps_);
    sum_.fill(0.0);
    steps_ = 0;
}

std::vector<Measurement> WallForce::latest() const
{
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < quantities; ++k) all.push_back({force_names[k], latest_[k], 0.0, unit_of(k)});
    return all;
}

std::vector<Measurement> WallForce::results() const
{
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < quantities; ++k) all.push_back(measurement(force_names[k], means_[k], unit_of(k)));
    return all;
}

void WallForce::persist(Archive& archive)
{
    archive(sum_, steps_, latest_);
    for (BlockMean& mean : means_) archive(mean);
}

} // namespace talus
