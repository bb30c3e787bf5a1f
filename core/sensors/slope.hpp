// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/block_mean.hpp"
#include "core/sensors/sensor.hpp"

#include <limits>

namespace talus
{

/// Inclination of a free surface along a direction: the bed in a turning drum, a flow down a chute.
///
/// The surface is cut into cells one mean diameter wide, along the direction and across it; the highest sphere top in
/// each cell, averaged across, gives a profile, and a least-squares line through it the angle, positive where the
/// surface falls along the direction. Its mean over the window has the error of block means.
class Slope : public Sensor
{
public:
    /// @param middle of the surface's part that is measured [m]; @param along unit vector; @param length of that part,
    /// half of it on either side of the middle [m]
    Slope(std::string name, const Vec3& middle, const Vec3& along, double length, const TimeWindow& window);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    void persist(Archive& archive) override { archive(angle_, mean_); }

private:
    Vec3 middle_, along_;
    double length_;
    TimeWindow window_;
    double angle_ = std::numeric_limits<double>::quiet_NaN(); ///< [degree]
    BlockMean mean_;
};

} // namespace talus
