// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/tile_contacts.hpp"
#include "core/packs/kernels.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// One contact with all its rows, for what is not a sweep.
struct WholeContact {
    Contact contact;
    ContactTerms terms;
    RollingRow rolling; ///< used where there is rolling resistance
    WallRow wall;       ///< used where walls move
};

/// @tparam wall whether it is one with a wall
template <bool wall, class R> WholeContact whole_contact(const TileContacts& contacts, std::size_t k)
{
    WholeContact all{contacts.contact(k), contacts.terms(k), {}, {}};
    if constexpr (R::rolling) all.rolling = contacts.rolling(k);
    if constexpr (wall && R::moving_walls) all.wall = contacts.wall(k);
    return all;
}

/// Velocity u = G v of sphere a relative to b (or to the wall) at the contact [m/s]: in spheres' own terms
/// u = v_a − v_b + s n × (a_a + a_b), a = r ω.
template <bool wall, class R> Vec3 contact_velocity(const WholeContact& own, const Motion* motion)
{
    const Contact& c = own.contact;
    const Motion& a = motion[c.a];
    Vec3 u = a.velocity;
    if constexpr (!wall) u -= motion[c.b].velocity;
    if constexpr (wall && R::moving_walls) u -= own.wall.velocity;
    if constexpr (R::spin) {
        Vec3 rim = a.rim_velocity;
        if constexpr (!wall) rim += motion[c.b].rim_velocity;
        u += own.terms.arm_scale * c.normal.cross(rim);
    }
    return u;
}

/// v ← v + M⁻¹ Gᵀ p for an impulse p of one contact.
template <bool wall, class R> void apply_impulse(const WholeContact& own, const Vec3& p, Motion* motion)
{
    const Contact& c = own.contact;
    Motion& a = motion[c.a];
    a.velocity += a.inverse_mass * p;
    Vec3 turn;
    if constexpr (R::spin) {
        turn = inverse_inertia_factor * own.terms.arm_scale * c.normal.cross(p);
        a.rim_velocity -= a.inverse_mass * turn;
    }
    if constexpr (!wall) {
        Motion& b = motion[c.b];
        b.velocity -= b.inverse_mass * p;
        if constexpr (R::spin) b.rim_velocity -= b.inverse_mass * turn;
    }
}

/// ω ← ω + I⁻¹ τ for an angular impulse τ of one contact's rolling row.
template <bool wall> void apply_rolling_impulse(const Contact& c, const Vec3& torque_impulse, Motion* motion)
{
    Motion& a = motion[c.a];
    a.rim_velocity += inverse_inertia_factor * a.inverse_mass / a.radius * torque_impulse;
    if constexpr (!wall) {
        Motion& b = motion[c.b];
        b.rim_velocity -= inverse_inertia_factor * b.inverse_mass / b.radius * torque_impulse;
    }
}

/// Spin of sphere a relative to b, or to the wall [rad/s].
template <bool wall, class R> Vec3 relative_spin(const WholeContact& own, const Motion* motion)
{
    const Contact& c = own.contact;
    Vec3 spin = motion[c.a].rim_velocity / motion[c.a].radius;
    if constexpr (!wall) spin -= motion[c.b].rim_velocity / motion[c.b].radius;
    if constexpr (wall && R::moving_walls) spin -= own.wall.spin;
    return spin;
}

template <bool with_moving_walls, class Work> auto with_rows(const ModelledPhysics& physics, Work&& work)
{
    if (physics.rolling) return work(Rows<true, true, true, with_moving_walls>{});
    if (physics.spin) return work(Rows<true, true, false, with_moving_walls>{});
    if (physics.friction) return work(Rows<true, false, false, with_moving_walls>{});
    return work(Rows<false, false, false, with_moving_walls>{});
}

/// Calls work(Rows<…>{}) with what the scene needs.
template <class Work> auto with_rows(const ModelledPhysics& physics, Work&& work)
{
    return physics.moving_walls ? with_rows<true>(physics, work) : with_rows<false>(physics, work);
}

} // namespace talus
