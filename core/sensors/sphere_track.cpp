// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/sphere_track.hpp"

#include <algorithm>
#include <limits>

namespace talus
{
namespace
{

constexpr std::array<const char*, 9> track_names = {
    "position_x", "position_y", "position_z", "velocity_x", "velocity_y", "velocity_z", "spin_x", "spin_y", "spin_z"};
constexpr std::array<const char*, 3> track_units = {"m", "m/s", "rad/s"};

} // namespace

SphereTrack::SphereTrack(std::string sensor_name, std::int64_t id) : Sensor(std::move(sensor_name)), id_(id)
{
    latest_.fill(std::numeric_limits<double>::quiet_NaN());
}

void SphereTrack::sample(const Snapshot& now)
{
    const State& state = now.state;
    latest_.fill(std::numeric_limits<double>::quiet_NaN());
    const auto found = std::ranges::find(state.id, id_);
    if (found == state.id.end()) return;
    const auto i = static_cast<std::size_t>(found - state.id.begin());
    const Body& body = state.body(i);
    const std::array<Vec3, 3> vectors = {state.position[i], body.velocity, body.spin()};
    for (std::size_t k = 0; k < latest_.size(); ++k) latest_[k] = vectors[k / 3][static_cast<int>(k % 3)];
}

std::vector<Measurement> SphereTrack::latest() const
{
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < latest_.size(); ++k)
        all.push_back({track_names[k], latest_[k], 0.0, track_units[k / 3]});
    return all;
}

std::string SphereTrack::silence() const
{
    return "sphere " + std::to_string(id_) + " is not there";
}

} // namespace talus
