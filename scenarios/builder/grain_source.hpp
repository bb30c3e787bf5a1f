// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/mixture.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace talus
{

/// Draws the spheres of a fill, so that it meets to one sphere what is asked for: its number, mass or volume, each
/// species its share of the mass, and a sieve analysis each of its classes.
class GrainSource
{
public:
    /// How much a fill is to hold: one of these; the others have no end.
    struct Amount {
        std::int64_t count = std::numeric_limits<std::int64_t>::max();
        double mass = infinity;   ///< [kg]
        double volume = infinity; ///< of the spheres [m³]
    };

    GrainSource(const Mixture& mixture, const Materials& materials, const Amount& amount);

    /// The next sphere: of what lacks most mass.
    Grain draw(Random& random);

    /// Whether there is room for a sphere more, as far as is known before it is drawn.
    bool is_open() const { return !complete_ && count_ < amount_.count; }

    /// Whether this sphere brings the fill nearer to its amount. One that does not completes it.
    bool wants(const Grain& grain);

    /// The sphere that was drawn last has found its place.
    void take(const Grain& grain);

    std::int64_t taken() const { return count_; }
    double max_diameter() const { return max_diameter_; } ///< [m]

private:
    /// What has a share of the mass of its own: a species, or a class of its sieve analysis.
    struct Part {
        int material = 0;
        SizeDistribution diameter;
        double share = 0.0; ///< of the mass; their sum is 1
        double mass = 0.0;  ///< of what was taken [kg]
    };

    const Materials& materials_;
    const Amount amount_;
    double max_diameter_, mean_mass_;
    std::vector<Part> parts_;
    std::size_t drawn_ = 0; ///< the part that the last sphere is of
    std::int64_t count_ = 0;
    double mass_ = 0.0, volume_ = 0.0; ///< of what was taken
    bool complete_ = false;

    double mass_of(const Grain& grain) const;
};

} // namespace talus
