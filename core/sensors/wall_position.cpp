// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/wall_position.hpp"

#include <limits>

namespace talus
{
namespace
{

constexpr std::array<const char*, 3> position_names = {"travel", "speed", "load"};
constexpr std::array<const char*, 3> position_units = {"m", "m/s", "N"};

} // namespace

WallPosition::WallPosition(std::string sensor_name, std::size_t piston, const TimeWindow& window)
    : Sensor(std::move(sensor_name)), piston_(piston), window_(window)
{
    latest_.fill(std::numeric_limits<double>::quiet_NaN());
}

/// The load is that with which the step began, as long as it acts.
WallPosition::Sample WallPosition::look(const Snapshot& now) const
{
    const Piston& piston = now.model.pistons[piston_];
    const PistonState& state = now.state.pistons[piston_];
    const double began = now.state.time - now.model.time_step;
    return {travel(piston, state), travel_speed(piston, state), piston.is_free(began) ? piston.load_at(began) : 0.0};
}

void WallPosition::watch(const Snapshot& now)
{
    if (!window_.contains(now.state.time)) return;
    const Sample sample = look(now);
    for (std::size_t k = 0; k < quantities; ++k) means_[k].add(sample[k]);
}

void WallPosition::sample(const Snapshot& now)
{
    latest_ = look(now);
}

std::vector<Measurement> WallPosition::latest() const
{
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < quantities; ++k) all.push_back({position_names[k], latest_[k], 0.0, position_units[k]});
    return all;
}

std::vector<Measurement> WallPosition::results() const
{
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < quantities; ++k)
        all.push_back(measurement(position_names[k], means_[k], position_units[k]));
    return all;
}

void WallPosition::persist(Archive& archive)
{
    archive(latest_);
    for (BlockMean& mean : means_) archive(mean);
}

} // namespace talus
