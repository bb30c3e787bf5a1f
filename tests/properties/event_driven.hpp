// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cstddef>
#include <vector>

namespace talus::test
{

/// A smooth hard sphere; all fall alike.
struct FreeSphere {
    Vec3 x, v; ///< [m], [m/s]
    double radius = 0.0, mass = 0.0;
};

/// A plane that stands still.
struct Face {
    Vec3 point, normal; ///< unit, into the free side
};

/// An impact: of two spheres, or of one with a wall.
struct Event {
    double time = 0.0;
    int a = -1;
    int b = -1; ///< sphere, or wall
    bool with_wall = false;
    double speed = 0.0; ///< with which they met, along the normal [m/s]

    bool same_bodies(const Event& other) const { return a == other.a && b == other.b && with_wall == other.with_wall; }
};

/// Hard spheres from impact to impact: flights are parabolas, so every instant is the root of a quadratic equation, and
/// at it Newton's law, u_n⁺ = −e u_n⁻, holds. There is nothing else in it: no rest, no friction, no step.
struct EventDriven {
    Vec3 gravity = Vec3::Zero();
    double restitution = 1.0;
    std::vector<Face> faces;
    std::vector<FreeSphere> spheres;
    double time = 0.0;
    Event last; ///< impact; those bodies touch, and part

    /// The next two impacts of all, the earlier one first; an instant is infinite where there is none.
    std::vector<Event> next_two() const;

    void fly(double until);          ///< without impacts
    void strike(const Event& event); ///< flies to it, and changes velocities
};

/// Seconds until two spheres whose distance is x and changes by v t touch; infinite where they do not.
double time_to_touch(const Vec3& x, const Vec3& v, double distance);

/// Seconds until height + speed t − fall t²/2 falls to zero; infinite where it does not.
double time_to_fall(double height, double speed, double fall);

} // namespace talus::test
