// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/size_distribution.hpp"
#include "core/world/material.hpp"

#include <vector>

namespace talus
{

/// A sphere before it has a place.
struct Grain {
    double diameter = 0.0; ///< [m]
    int material = 0;
};

/// One kind of sphere in a mixture.
struct Species {
    int material = 0;
    SizeDistribution diameter;
    double number = 1.0; ///< its share of the spheres, by number
};

/// What a fill or a pour is made of: one species or several, whose numbers add up to 1.
struct Mixture {
    std::vector<Species> species;

    Grain draw(Random& random) const;

    double min_diameter() const; ///< [m]
    double max_diameter() const; ///< [m]

    /// Of a sphere, by number [m].
    double mean_diameter() const;

    /// Of a sphere, by number [m³].
    double mean_volume() const;

    /// Of a sphere, by number [kg].
    double mean_mass(const Materials& materials) const;
};

/// Turns shares of the mass into shares of the number.
/// @param mass_shares of the species, above 0, in any unit
Mixture mixture_by_mass(
    std::vector<Species> species, const std::vector<double>& mass_shares, const Materials& materials);

} // namespace talus
