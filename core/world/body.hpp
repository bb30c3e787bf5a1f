// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"
#include "core/world/solid_sphere.hpp"

#include <cstddef>
#include <type_traits>

namespace talus
{

/// What impulses move: all that a sweep reads and writes of it, one cache line of 64 B.
///
/// Its spin is kept as a = r ω [m/s], r being the radius of its sphere, for then neither radius nor inertia stands in
/// the contact kernel of solid spheres: an impulse p at the contact changes a by −5/2 p_n×t / m whatever the radius.
struct alignas(64) Body {
    Vec3 velocity = Vec3::Zero();     ///< of its centre of mass [m/s]
    double inverse_mass = 0.0;        ///< 1/m [1/kg]
    Vec3 rim_velocity = Vec3::Zero(); ///< a = r ω [m/s]
    double spin_radius = 0.0;         ///< r of a = r ω [m]

    double mass() const { return 1.0 / inverse_mass; }
    Vec3 spin() const { return rim_velocity / spin_radius; } ///< ω [rad/s]

    /// 1/I [1/(kg m²)].
    double inverse_inertia() const { return inverse_inertia_factor * inverse_mass / (spin_radius * spin_radius); }

    /// Of translation and rotation [J].
    double kinetic_energy() const
    {
        return 0.5 * mass() * (velocity.squaredNorm() + rim_velocity.squaredNorm() / inverse_inertia_factor);
    }

    /// About the origin, where its centre of mass is at x [kg m²/s].
    Vec3 angular_momentum(const Vec3& x) const
    {
        return mass() * (x.cross(velocity) + spin_radius / inverse_inertia_factor * rim_velocity);
    }

    void persist(Archive& archive) { archive(velocity, inverse_mass, rim_velocity, spin_radius); }
};
static_assert(sizeof(Body) == 64 && std::is_standard_layout_v<Body> && offsetof(Body, velocity) == 0 &&
              offsetof(Body, inverse_mass) == 24 && offsetof(Body, rim_velocity) == 32 &&
              offsetof(Body, spin_radius) == 56); // kernels read it as eight numbers

} // namespace talus
