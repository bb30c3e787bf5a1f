// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/block_mean.hpp"
#include "core/sensors/sensor.hpp"

namespace talus
{

/// Mass flow through a plane: how fast the mass that was inserted and is no longer behind the plane grows. Spheres that
/// left through an outlet have passed, wherever the outlet is.
///
/// Through a plane across a periodic axis, where nothing is behind or beyond, it is the mean over all such planes: in a
/// step Σ m v·n h / length of the cell passes.
///
/// The result is the mean over the window, what has passed between its first sample and its last by the time between
/// them, with the standard error of block means of the flow from sample to sample (block_mean.hpp).
class MassFlow : public Sensor
{
public:
    /// @param normal unit, the direction of the flow; @param window the steady part
    MassFlow(std::string name, const Vec3& point, const Vec3& normal, const TimeWindow& window);

    void watch(const Snapshot& now) override;
    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    std::string silence() const override { return "fewer than two samples fell into its window"; }
    void persist(Archive& archive) override { archive(passed_, mass_flow_, sphere_flow_, flowed_mass_, flowed_count_); }

private:
    /// What has passed up to a sample.
    struct Passed {
        double time = -infinity; ///< [s]; before the first sample in no window
        double mass = 0.0;       ///< [kg]
        double count = 0.0;
    };
    Vec3 point_, normal_;
    TimeWindow window_;
    Passed passed_;                                 ///< up to the last sample
    BlockMean mass_flow_, sphere_flow_;             ///< [kg/s], [1/s]
    double flowed_mass_ = 0.0, flowed_count_ = 0.0; ///< through planes across a periodic axis [kg], [1]

    /// The length of the cell along the normal [m]; infinite where that axis is not periodic.
    double cell_length(const Periodicity& periodicity) const;

    Passed passed_so_far(const Snapshot& now) const;
};

} // namespace talus
