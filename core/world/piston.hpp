// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/pose.hpp"
#include "core/base/vector.hpp"

#include <vector>

namespace talus
{

/// The load at a time; straight lines lead from one to the next.
struct LoadPoint {
    double time = 0.0;  ///< [s]
    double force = 0.0; ///< along the guide [N]
};

/// A piston: a wall of finite mass, which forces move, along the one axis that its guide leaves it.
struct Piston {
    std::size_t wall = 0;        ///< index of the wall that is its shape
    double mass = 0.0;           ///< [kg]
    Vec3 guide = Vec3::UnitZ();  ///< unit: the axis of its motion, and which way its load counts
    Vec3 center = Vec3::Zero();  ///< of its mass, as the scene puts it [m]
    Eigen::Matrix3d inertia;     ///< about the centre, as the scene puts it [kg m²]
    std::vector<LoadPoint> load; ///< in ascending order of time, held at its ends; empty: no load
    double released_at = 0.0;    ///< until then the guide holds it altogether [s]

    bool is_free(double time) const { return time >= released_at; }

    /// The load along the guide [N].
    double load_at(double time) const;

    /// The most that weight and load ever press along the guide, either way [N].
    double most_force(const Vec3& gravity) const;

    /// What gravity and load add to its velocity in a step that begins at this time, where nothing else touches it
    /// [m/s]; along the guide, for the rest is the guide's to carry, as is all of it until the piston is released.
    Vec3 free_gain(const Vec3& gravity, double time, double step) const;
};

/// Inertia of a block of this size that is filled evenly, about its centre [kg m²].
Eigen::Matrix3d block_inertia(double mass, const Vec3& extent);

/// Where a piston is and how it moves.
struct PistonState {
    using GuideVector = Eigen::Matrix<double, 6, 1>;

    Pose pose;                                       ///< from where the scene puts it
    Vec3 velocity = Vec3::Zero();                    ///< of its centre [m/s]
    Vec3 spin = Vec3::Zero();                        ///< ω [rad/s]
    GuideVector guide_impulse = GuideVector::Zero(); ///< of the last step, by the guide's rows [N s, N m s]

    void persist(Archive& archive)
    {
        archive(pose, velocity, spin);
        for (double& number : guide_impulse) archive(number);
    }
};

/// Its velocity field.
Twist twist_of(const Piston& piston, const PistonState& state);

/// How far it has come along its guide [m], and how fast it goes on [m/s].
double travel(const Piston& piston, const PistonState& state);
double travel_speed(const Piston& piston, const PistonState& state);

double kinetic_energy(const Piston& piston, const PistonState& state); ///< [J]

/// Moves on for a step with the velocity and spin that it has: x ← x + h v, and a turn by h ω about the centre.
void move(const Piston& piston, PistonState& state, double step);

} // namespace talus
