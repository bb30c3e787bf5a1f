// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/slope.hpp"

#include "core/base/statistics.hpp"

#include <cmath>
#include <map>

namespace talus
{

Slope::Slope(std::string sensor_name, const Vec3& middle, const Vec3& along, double length, const TimeWindow& window)
    : Sensor(std::move(sensor_name)), middle_(middle), along_(along), length_(length), window_(window)
{
}

void Slope::sample(const Snapshot& now)
{
    const double width = now.model.mean_diameter;
    const Vec3 up = (now.model.up() - now.model.up().dot(along_) * along_).normalized();
    const Vec3 sideways = up.cross(along_);

    std::map<std::int64_t, std::map<std::int64_t, double>> top; // by cell along and across
    for (std::size_t i = 0; i < now.state.count(); ++i) {
        const Vec3 x = now.state.position[i] - middle_;
        const double s = x.dot(along_);
        if (std::abs(s) > 0.5 * length_) continue;
        const auto row = static_cast<std::int64_t>(std::floor(s / width));
        const auto lane = static_cast<std::int64_t>(std::floor(x.dot(sideways) / width));
        const double height = x.dot(up) + now.state.radius[i];
        const auto [cell, is_new] = top[row].try_emplace(lane, height);
        if (!is_new) cell->second = std::max(cell->second, height);
    }
    LineFit line;
    for (const auto& [row, lanes] : top) {
        MeanAndError mean;
        for (const auto& [lane, height] : lanes) mean.add(height);
        line.add((static_cast<double>(row) + 0.5) * width, mean.mean());
    }
    angle_ = line.fall_angle();
    if (window_.contains(now.state.time)) mean_.add(angle_);
}

std::vector<Measurement> Slope::latest() const
{
    return {{"angle", angle_, 0.0, "deg"}};
}

std::vector<Measurement> Slope::results() const
{
    return {measurement("angle", mean_, "deg")};
}

} // namespace talus
