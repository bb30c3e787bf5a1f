// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"

#include <limits>

namespace talus
{

/// Angle of repose of a heap round an axis through `base`, straight up against gravity. The heap's surface is where a
/// grain of the mean diameter that is let down meets it. On a grid of a third of a diameter, every cell alike, the
/// angle is that of the straight line of height over distance from the axis, between inner_radius and outer_radius;
/// where those are not given, from 80 % of the heap's height down to 20 %, or to one and a half diameters, where single
/// grains lie. A heap that is no cone has the slope of its mean over the azimuth.
/// The foot is the distance from the axis within which 99 % of the mass lies: what lies farther out does not count.
/// The spread is the standard error over the angles of eight azimuth octants.
///
/// Spheres faster than 0.3 √(g d) fall or flow and are not part of the surface. There is no heap, and no angle as a
/// result, where they are more than a twentieth of the mass, where it is less than three diameters high, or where its
/// flank is less than two and a half diameters wide.
class Repose : public Sensor
{
public:
    /// @param base centre of the heap's floor [m]; @param outer_radius 0: chosen by height
    Repose(std::string name, const Vec3& base, double inner_radius, double outer_radius);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    std::string silence() const override;
    void persist(Archive& archive) override { archive(angle_, spread_, apex_, foot_, moving_, height_, width_); }

private:
    static constexpr double nothing_yet = std::numeric_limits<double>::quiet_NaN();
    static constexpr double most_moving = 0.05, least_height = 3.0, least_width = 2.5;

    Vec3 base_;
    double inner_radius_, outer_radius_;
    double angle_ = nothing_yet, spread_ = nothing_yet; ///< [degree]; not a number while there is no heap
    double apex_ = 0.0;                                 ///< height of the highest ring mean [m]
    double foot_ = 0.0;   ///< distance from the axis within which 99 % of the mass lies [m]
    double moving_ = 0.0; ///< share of the mass that is too fast for a heap
    double height_ = 0.0; ///< of the apex, in mean diameters
    double width_ = 0.0;  ///< of the flank, in mean diameters

    bool is_heap() const { return moving_ <= most_moving && height_ >= least_height && width_ >= least_width; }
};

} // namespace talus
