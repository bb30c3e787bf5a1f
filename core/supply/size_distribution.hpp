// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"

#include <vector>

namespace talus
{

/// The spheres between two neighbouring sieves: by mass spread evenly over the diameters between them, so their number
/// goes with 1/d³.
struct SieveClass {
    double min = 0.0;    ///< [m], above 0
    double max = 0.0;    ///< [m], above min
    double number = 0.0; ///< their share of the spheres, by number
};

/// The diameters of a kind of sphere, by number.
struct SizeDistribution {
    enum class Law { uniform, normal, lognormal, sieve };
    double min = 0.0; ///< [m]
    double max = 0.0; ///< [m]; uniform between the two, one size where they are equal
    Law law = Law::uniform;
    double center = 0.0; ///< normal: the mean [m], lognormal: that of ln(d / 1 m), both before min and max cut it
    double spread = 0.0; ///< standard deviation before min and max cut it: of d [m], or of ln d
    std::vector<SieveClass> classes = {}; ///< sieve only, from fine to coarse; their numbers add up to 1

    double draw(Random& random) const;

    /// Mean of d [m].
    double mean() const;

    /// Mean of d³ π/6 [m³].
    double mean_volume() const;

    /// The share of the uncut normal or lognormal distribution that lies between min and max; else 1.
    double share_inside() const;
};

/// The distribution of which a sieve analysis tells the cumulative share of mass.
/// @param sizes of the sieves [m], rising, above 0
/// @param passing the share of the mass that passes each, from 0 to 1, never falling
SizeDistribution sieved_sizes(const std::vector<double>& sizes, const std::vector<double>& passing);

} // namespace talus
