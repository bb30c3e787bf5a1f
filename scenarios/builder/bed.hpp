// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/deep_beds/choice.hpp"
#include "core/simulation/simulation.hpp"

#include <set>

namespace talus
{

/// Of the room that a bed takes, what its spheres fill.
inline constexpr double packed_share = 0.6;

/// The bed that the spheres of a scene will make, as far as its fills, pours and walls tell beforehand.
struct Bed {
    BedMeasures measures;               ///< how deep it may become, and the ratios of its masses
    double screening_length = infinity; ///< Λ, below which rough walls carry what comes on top [mean diameters]
    double landing = 0.0;               ///< how far a sphere may fall until it lands [m]
    double wall_acceleration = 0.0;     ///< of what moves as prescribed, at most [m/s²]
    double surcharge = 0.0;             ///< the pressure of a piston on it, at most [Pa]

    /// The depth whose weight it bears: twice the mean of Λ (1 − exp(−z/Λ)) over its depth (Janssen 1895) [mean
    /// diameters].
    double borne_depth() const;
};

double volume_of_sphere(double diameter);

/// The materials that spheres are made of, now or later.
std::set<int> sphere_materials(const Simulation& simulation);

/// Measures the bed of a simulation whose spheres, pours and walls are there.
Bed measure_bed(const Simulation& simulation);

} // namespace talus
