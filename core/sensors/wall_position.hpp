// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/block_mean.hpp"
#include "core/sensors/sensor.hpp"

#include <array>

namespace talus
{

/// How far a piston has come along its guide from where the scene puts it [m], how fast it goes on [m/s], and the load
/// on it [N]. A sample is that of the last step; the results are means over every step in a window of time, with the
/// standard error of block means (block_mean.hpp).
class WallPosition : public Sensor
{
public:
    /// @param piston its index
    WallPosition(std::string name, std::size_t piston, const TimeWindow& window);

    void watch(const Snapshot& now) override;
    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    void persist(Archive& archive) override;

private:
    static constexpr std::size_t quantities = 3;
    using Sample = std::array<double, quantities>;

    std::size_t piston_;
    TimeWindow window_;
    Sample latest_;
    std::array<BlockMean, quantities> means_;

    Sample look(const Snapshot& now) const;
};

} // namespace talus
