// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/supply/mixture.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <limits>

namespace talus
{

/// Spheres that enter during the run, at random places of a region, never overlapping anything. How many and how fast
/// is a matter of number or of mass, whichever is finite.
struct Pour {
    std::string name;
    Region region;
    Mixture mixture;
    std::int64_t count = std::numeric_limits<std::int64_t>::max(); ///< in all
    double mass = infinity;                                        ///< in all [kg]
    double rate = infinity;                                        ///< spheres per second
    double mass_rate = infinity;                                   ///< [kg/s]
    Vec3 velocity = Vec3::Zero();                                  ///< of the entering spheres
    double start = 0.0;                                            ///< [s]

    // What changes:
    std::int64_t poured = 0;  ///< so far
    double poured_mass = 0.0; ///< so far [kg]
    std::int64_t refused = 0; ///< times that no free place was found and the sphere had to wait
    Grain pending;            ///< the deferred sphere; diameter 0: none drawn
    Random random;

    void persist(Archive& archive)
    {
        archive(poured, poured_mass, refused, pending.diameter, pending.material, random);
    }
};

/// Whether all has come in. A pour by mass ends with the sphere that reaches it.
bool is_over(const Pour& source);

/// Whether the next sphere should have entered by this time: the first at the start, the others as the rate asks.
bool is_due(const Pour& source, double time);

/// Whether more than one sphere (of the mean mass) should have entered by this time and has not.
bool is_behind(const Pour& source, double time, const Materials& materials);

/// How many spheres will come in, by a pour by mass on average.
double expected_count(const Pour& source, const Materials& materials);

/// Lets in what is due at the state's time. A sphere that finds no free place in 50 tries is deferred to the next step.
/// Returns how many came in.
std::size_t pour(Pour& source, State& state, const Model& model);

} // namespace talus
