// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/block_mean.hpp"
#include "core/sensors/sensor.hpp"

#include <array>

namespace talus
{

/// Force [N] and torque about a point [N m] of the spheres on a wall: what wall_load.hpp says of a step, divided by the
/// step. A sample is the mean over every step since the sample before; the results are means over every step in a
/// window of time, with the standard error of block means (block_mean.hpp). Only steps count in which the wall stands.
class WallForce : public Sensor
{
public:
    /// @param wall its index; @param point that torques are about, fixed in space [m]
    WallForce(std::string name, std::size_t wall, const Vec3& point, const TimeWindow& window);

    /// @pre the report has the wall loads: `ModelledPhysics::wall_loads`
    void watch(const Snapshot& now) override;
    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    void persist(Archive& archive) override;

private:
    static constexpr std::size_t quantities = 6; ///< force and torque
    using Load = std::array<double, quantities>;

    std::size_t wall_;
    Vec3 point_;
    TimeWindow window_;
    Load sum_{};             ///< over the steps since the last sample …
    std::int64_t steps_ = 0; ///< … so many
    Load latest_;
    std::array<BlockMean, quantities> means_;
};

} // namespace talus
