// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/incidents.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

// What is read from the state, which is never written.

double kinetic_energy(const State& state);                        ///< of the spheres [J]
double potential_energy(const State& state, const Vec3& gravity); ///< −Σ m g·x of the spheres [J]
/// Of one sphere, kinetic and potential, periodic axes left out [J].
double sphere_energy(const State& state, const Model& model, std::size_t i);

Vec3 linear_momentum(const State& state);  ///< Σ m v [kg m/s]
Vec3 angular_momentum(const State& state); ///< Σ (x × m v + I ω) about the origin [kg m²/s]

/// Linear and angular momentum, the latter about the origin.
struct Momentum {
    Vec3 linear = Vec3::Zero();  ///< Σ m v [N s]
    Vec3 angular = Vec3::Zero(); ///< Σ (x × m v + I ω) [N m s]

    Momentum& operator+=(const Momentum& other);
};

/// What a pass over the spheres and pistons says about a step.
struct StateSurvey {
    double kinetic_energy = 0.0;     ///< of the new velocities, pistons included, as in the rest [J]
    double potential_energy = 0.0;   ///< −Σ m g·x of the new positions, periodic axes left out [J]
    double gravity_work = 0.0;       ///< of gravity along periodic axes in the step [J]
    double load_work = 0.0;          ///< that loads did on pistons, and own forces on spheres, in the step [J]
    Momentum momentum;               ///< of the spheres, with the new velocities in the new places
    Momentum from_gravity;           ///< what gravity and own forces gave them in the step, where they were
    double fastest_speed = 0.0;      ///< [m/s]
    std::vector<Incident> incidents; ///< in storage order, pistons last; empty in every healthy step

    /// The next sub-step: sums of work, the fastest, the energies of the last.
    void then(StateSurvey next);
};

/// @param h of the step, which has been made [s]; what loads did on pistons is not known here
StateSurvey survey_state(const State& state, const Model& model, double h);

} // namespace talus
