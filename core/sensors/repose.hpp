// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"

#include <limits>

namespace talus
{

/// Angle of repose of a heap round an axis through `base`, straight up against gravity: the slope of a line through
/// ring means of the highest sphere tops (rings one diameter wide, 16 azimuth sectors), over the rings between
/// inner_radius and outer_radius; where those are not given, over the rings between 20 and 80 % of the heap's height.
/// The foot is the distance from the axis within which 99 % of the mass lies: grains that roll away alone do not count.
/// The spread is the standard error over the angles of eight azimuth octants.
///
/// Spheres faster than 0.3 √(g d) fall or flow and are not part of the surface. There is no heap, and no angle as a
/// result, where they are more than a twentieth of the mass, where it is less than three diameters high, or where its
/// flank has fewer than three rings.
class Repose : public Sensor
{
public:
    /// @param base centre of the heap's floor [m]; @param outer_radius 0: choose the rings by height
    Repose(std::string name, const Vec3& base, double inner_radius, double outer_radius);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    std::string silence() const override;
    void persist(Archive& archive) override { archive(angle_, spread_, apex_, foot_, moving_, height_, rings_); }

private:
    static constexpr double nothing_yet = std::numeric_limits<double>::quiet_NaN();
    static constexpr double most_moving = 0.05, least_height = 3.0;
    static constexpr std::int64_t least_rings = 3;

    Vec3 base_;
    double inner_radius_, outer_radius_;
    double angle_ = nothing_yet, spread_ = nothing_yet; ///< [degree]; not a number while there is no heap
    double apex_ = 0.0;                                 ///< height of the highest ring mean [m]
    double foot_ = 0.0;      ///< distance from the axis within which 99 % of the mass lies [m]
    double moving_ = 0.0;    ///< share of the mass that is too fast for a heap
    double height_ = 0.0;    ///< of the apex, in mean diameters
    std::int64_t rings_ = 0; ///< of the flank

    bool is_heap() const { return moving_ <= most_moving && height_ >= least_height && rings_ >= least_rings; }
};

} // namespace talus
