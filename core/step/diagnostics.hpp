// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// Reads the state and never writes it.

double kinetic_energy(const Motion& motion);                      ///< of one solid sphere, translation and rotation [J]
double kinetic_energy(const State& state);                        ///< of the spheres [J]
double potential_energy(const State& state, const Vec3& gravity); ///< −Σ m g·x of the spheres [J]
Vec3 linear_momentum(const State& state);                         ///< Σ m v [kg m/s]
Vec3 angular_momentum(const State& state);                        ///< Σ (x × m v + I ω) about the origin [kg m²/s]

/// Something that must not go on unseen: a sphere, or a piston, that escaped, is not a number, or moves faster than it
/// can; or bodies that are pressed together so that no motion obeys their contacts (press.hpp).
struct Incident {
    enum class Kind { escaped, not_a_number, blow_up, pressed };
    Kind kind = Kind::escaped;
    std::int64_t id = -1; ///< of the sphere; −1: it is a piston, that of the wall below
    Vec3 position = Vec3::Zero();
    double speed = 0.0;          ///< [m/s]
    std::int32_t last_wall = -1; ///< index of the wall that the sphere touched last, −1: none; of a piston, its own
    std::vector<std::int64_t> spheres = {}; ///< all that are pressed together, by id …
    std::vector<std::int32_t> walls = {};   ///< … and by index the walls that press them
    double overlap = 0.0;                   ///< of the contact that tells it [m]

    bool of_piston() const { return id < 0; }
};

/// What a pass over the spheres and pistons tells about a step.
struct StateSurvey {
    double kinetic_energy = 0.0;     ///< [J]
    double potential_energy = 0.0;   ///< of the axes that are not periodic [J]
    double gravity_work = 0.0;       ///< of gravity along periodic axes at the present velocities, in a step [J]
    double fastest_speed = 0.0;      ///< [m/s]
    std::size_t long_moves = 0;      ///< spheres that move more than 0.1 d in a whole step at their speed, and pistons
    std::vector<Incident> incidents; ///< in storage order, pistons last
};

StateSurvey survey_state(const State& state, const Model& model);

} // namespace talus
