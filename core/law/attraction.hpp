// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/material.hpp"

#include <algorithm>
#include <cmath>

/// What draws two spheres, or a sphere and a wall, together: METHOD, attraction.
///
/// Two attract each other from when they touch until their gap exceeds the range. Their force F never grows with the
/// gap, and a step takes that of its beginning. So opening costs at least the energy that the gap gains, closing brings
/// at most what it loses: attraction makes no energy.
namespace talus
{

/// An attraction between two of this size.
class AttractionOfPair
{
public:
    /// @param reduced_radius R* = r_a r_b/(r_a + r_b), at a wall r [m]; @param weight of the lighter one [N]
    AttractionOfPair(const Attraction& law, double reduced_radius, double weight)
        : touching_(law.force + law.by_radius * reduced_radius + law.by_weight * weight), range_(law.range),
          per_length_(law.volume > 0.0 ? std::sqrt(2.0 * reduced_radius / law.volume) : 0.0)
    {
    }

    /// F [N]: at most that of touching; that of a liquid bridge goes with 1/(1 + 1.05 s + 2.5 s²), s = g √(2R*/V)
    /// (Willett, Adams, Johnson & Seville 2000, with Derjaguin's radius 2R*).
    double force(double gap) const
    {
        if (gap > range_) return 0.0;
        const double s = per_length_ * std::max(gap, 0.0);
        return touching_ / (1.0 + linear * s + square * s * s);
    }

    /// Its energy, less than 0 up to the range [J].
    double energy(double gap) const
    {
        if (gap >= range_) return 0.0;
        const double opened = std::max(gap, 0.0);
        const double beyond =
            per_length_ > 0.0 ? (sum(per_length_ * range_) - sum(per_length_ * opened)) / per_length_ : range_ - opened;
        return -touching_ * (beyond + opened - gap);
    }

private:
    static constexpr double linear = 1.05, square = 2.5;

    double touching_;   ///< F at a gap of 0 [N]
    double range_;      ///< [m]
    double per_length_; ///< s by the gap [1/m]

    /// ∫ ds/(1 + 1.05 s + 2.5 s²) from 0 to s.
    static double sum(double s)
    {
        const double root = std::sqrt(4.0 * square - linear * linear);
        return 2.0 / root * (std::atan((2.0 * square * s + linear) / root) - std::atan(linear / root));
    }
};

} // namespace talus
