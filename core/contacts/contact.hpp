// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"
#include "core/law/touch_record.hpp"

#include <cstdint>

namespace talus
{

/// One contact of a step, taken out of its packs. A sphere–sphere contact joins spheres a and b; in a sphere–wall
/// contact b is the wall's index.
struct Contact {
    std::int32_t a = 0;
    std::int32_t b = 0;
    Vec3 normal = Vec3::UnitZ(); ///< n, unit, from b to a
    Vec3 impulse = Vec3::Zero(); ///< λ [N s] on a: normal part λ_n n with λ_n ≥ 0, the rest tangential

    ContactKind kind = ContactKind::open; ///< of the law that it follows
    double target = 0.0;                  ///< q_n [m/s]
    double compliance = 0.0;              ///< Σ_n [1/kg]
    double parting = infinity;            ///< u_n that it asks for at most [m/s]
    double friction = 0.0;                ///< μ
    double arm_scale = 1.0;         ///< s = |x_a − x_b| / (r_a + r_b); 1 at walls: lever arms add up to the distance
    double inverse_mass_sum = 0.0;  ///< W = 1/m_a + 1/m_b [1/kg]
    Vec3 attraction = Vec3::Zero(); ///< impulse with which b draws a to itself besides λ [N s]

    double gap = 0.0;         ///< g at the beginning of the step [m]; < 0 is overlap
    double wall_level = 0.0;  ///< n·x at which the gap to the wall is zero after the step [m]; at walls
    double compression = 0.0; ///< κ: what of the overlap a load has pressed [m]; −∞: it will keep none
    TouchRecord touch = {};   ///< what is known from the steps before; after carry_impulses with this one
    std::uint32_t slot = 0;   ///< where it is kept what it carries

    double normal_impulse() const { return impulse.dot(normal); }
    /// What b does to a in all [N s].
    Vec3 whole_impulse() const { return impulse + attraction; }
};

/// The rolling row of a contact, and that of twisting; only where a scene resists one of them.
struct RollingRow {
    Vec3 impulse = Vec3::Zero(); ///< angular impulse on a [N m s], at right angles to n …
    double twist = 0.0;          ///< … and along n
    double reach = 0.0;          ///< μ_r R* [m]: |impulse| ≤ μ_r R* λ_n
    double twist_reach = 0.0;    ///< μ_t R* [m]: |twist| ≤ μ_t R* λ_n
    double inertia = 0.0;        ///< 1 / (1/I_a + 1/I_b) [kg m²]
};

/// How the wall moves where a contact is, the mean over the step; only where walls move.
struct WallRow {
    Vec3 velocity = Vec3::Zero(); ///< of its material at x − r n [m/s]
    Vec3 spin = Vec3::Zero();     ///< [rad/s]
    double gain = 0.0;            ///< by how much its velocity along n has grown since the step before [m/s]
};

} // namespace talus
