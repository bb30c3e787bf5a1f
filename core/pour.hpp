// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model.hpp"
#include "core/region.hpp"
#include "core/state.hpp"

namespace talus
{

/// The diameters of a kind of sphere.
struct SizeDistribution {
    double min = 0.0; ///< [m]
    double max = 0.0; ///< [m]; uniform between the two, one size where they are equal

    double draw(Random& random) const { return min + (max - min) * uniform(random); }
    double mean() const { return 0.5 * (min + max); }

    /// Mean of d³ π/6 [m³].
    double mean_volume() const;
};

/// Spheres that enter during the run, at random places of a region, never overlapping anything.
struct Pour {
    std::string name;
    Region region;
    SizeDistribution diameter;
    int material = 0;
    double rate = 0.0;            ///< spheres per second
    std::int64_t count = 0;       ///< in all
    Vec3 velocity = Vec3::Zero(); ///< of the entering spheres
    double start = 0.0;           ///< [s]

    // What changes:
    std::int64_t poured = 0;       ///< so far
    std::int64_t refused = 0;      ///< times that no free place was found and the sphere had to wait
    double pending_diameter = 0.0; ///< of the sphere that waits; 0: none drawn
    Random random;

    void persist(Archive& archive) { archive(poured, refused, pending_diameter, random); }
};

/// How many spheres should have entered by this time: the first at the start, then `rate` a second, at most `count`.
std::int64_t due_count(const Pour& source, double time);

/// Lets in what is due at the state's time. A sphere that finds no free place in 50 tries waits for the next step.
/// Returns how many came in.
std::size_t pour(Pour& source, State& state, const Model& model);

} // namespace talus
