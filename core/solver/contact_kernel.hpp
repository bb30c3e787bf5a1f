// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sweep_sums.hpp"
#include "core/contacts/contact_network.hpp"
#include "core/world/state.hpp"

#include <cmath>
#include <type_traits>

namespace talus
{

/// What the sweep of a scene contains; chosen once for a solve, so that what a scene does not need is not there.
template <bool with_friction, bool with_spin, bool with_rolling, bool with_moving_walls> struct Rows {
    static constexpr bool friction = with_friction;
    static constexpr bool spin = with_spin;
    static constexpr bool rolling = with_rolling;
    static constexpr bool moving_walls = with_moving_walls;
};

/// What some contacts have besides; null where the scene has none.
struct SideRows {
    RollingRow* rolling = nullptr;
    const WallRow* wall = nullptr;
};

/// Velocity u = G v of sphere a relative to b (or to the wall) at the contact [m/s]: in spheres' own terms
/// u = v_a − v_b + s n × (a_a + a_b), a = r ω.
template <bool wall, class R>
Vec3 contact_velocity(const Contact& c, const ContactTerms& terms, const SideRows& rows, const Motion* motion)
{
    const Motion& a = motion[c.a];
    Vec3 u = a.velocity;
    if constexpr (!wall) u -= motion[c.b].velocity;
    if constexpr (wall && R::moving_walls) u -= rows.wall->velocity;
    if constexpr (R::spin) {
        Vec3 rim = a.rim_velocity;
        if constexpr (!wall) rim += motion[c.b].rim_velocity;
        u += terms.arm_scale * c.normal.cross(rim);
    }
    return u;
}

/// v ← v + M⁻¹ Gᵀ p for an impulse p of one contact.
template <bool wall, class R>
void apply_impulse(const Contact& c, const ContactTerms& terms, const Vec3& p, Motion* motion)
{
    Motion& a = motion[c.a];
    a.velocity += a.inverse_mass * p;
    Vec3 turn;
    if constexpr (R::spin) {
        turn = inverse_inertia_factor * terms.arm_scale * c.normal.cross(p);
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

/// The impulse that solves one contact with all others held, normal first, then friction on the disk of the new normal
/// impulse; exactly where the relaxation ω is 1:
///
///   λ_n ← max(0, λ_n − ω (u_n + Σ_n λ_n − q_n) / (W + Σ_n))                       METHOD (6)
///   λ_t ← projection of λ_t − ω u_t / (W (1 + 5/2 s²)) on the disk |λ_t| ≤ μ λ_n  METHOD (7)
template <class R> Vec3 solved_impulse(const Contact& c, const ContactTerms& terms, const Vec3& u, double relaxation)
{
    const double u_n = u.dot(c.normal);
    const double old_normal = c.impulse.dot(c.normal);
    const double new_normal =
        std::max(0.0, old_normal - relaxation * ((u_n + terms.compliance * old_normal - c.target) * terms.normal_mass));
    if constexpr (!R::friction)
        return new_normal * c.normal;
    else {
        Vec3 tangent = (c.impulse - old_normal * c.normal) - relaxation * terms.tangent_mass * (u - u_n * c.normal);
        const double largest = terms.friction * new_normal;
        const double size_squared = tangent.squaredNorm();
        if (size_squared > largest * largest) tangent *= largest / std::sqrt(size_squared);
        return new_normal * c.normal + tangent;
    }
}

/// Spin of sphere a relative to b, or to the wall [rad/s].
template <bool wall, class R> Vec3 relative_spin(const Contact& c, const SideRows& rows, const Motion* motion)
{
    Vec3 spin = motion[c.a].rim_velocity / motion[c.a].radius;
    if constexpr (!wall) spin -= motion[c.b].rim_velocity / motion[c.b].radius;
    if constexpr (wall && R::moving_walls) spin -= rows.wall->spin;
    return spin;
}

/// The rolling row's impulse on the disk |τ| ≤ μ_r R* λ_n, against the relative spin across the normal; METHOD (8).
template <bool wall, class R>
Vec3 solved_rolling_impulse(const Contact& c, const SideRows& rows, const Motion* motion, double relaxation)
{
    const RollingRow& row = *rows.rolling;
    const Vec3 spin = relative_spin<wall, R>(c, rows, motion);
    Vec3 impulse = row.impulse - relaxation * row.inertia * (spin - spin.dot(c.normal) * c.normal);
    const double largest = row.reach * c.impulse.dot(c.normal);
    const double size_squared = impulse.squaredNorm();
    if (size_squared > largest * largest) impulse *= largest / std::sqrt(size_squared);
    return impulse;
}

/// Relaxes one contact. With `apply` off nothing changes and the sums tell how far the contact is from its law.
template <bool wall, class R, bool apply>
void relax(
    Contact& c, const ContactTerms& terms, const SideRows& rows, Motion* motion, double relaxation, SweepSums& sums)
{
    const Vec3 solved = solved_impulse<R>(c, terms, contact_velocity<wall, R>(c, terms, rows, motion), relaxation);
    const Vec3 change = solved - c.impulse;
    sums.change += terms.inverse_mass_sum * change.squaredNorm();
    sums.size += terms.inverse_mass_sum * solved.squaredNorm();
    if constexpr (apply) {
        c.impulse = solved;
        apply_impulse<wall, R>(c, terms, change, motion);
    }
    if constexpr (R::rolling) {
        RollingRow& row = *rows.rolling;
        const Vec3 rolling = solved_rolling_impulse<wall, R>(c, rows, motion, relaxation);
        const Vec3 rolling_change = rolling - row.impulse;
        sums.change += rolling_change.squaredNorm() / row.inertia;
        sums.size += rolling.squaredNorm() / row.inertia;
        if constexpr (apply) {
            row.impulse = rolling;
            apply_rolling_impulse<wall>(c, rolling_change, motion);
        }
    }
}

/// Calls visit(contact, terms, rows, is_wall) for the contacts of one tile, those between spheres first.
template <class Visit> void for_each_contact(StepContacts& contacts, std::size_t tile, Visit&& visit)
{
    const auto visit_all = [&](ContactArrays& arrays, auto is_wall) {
        RollingRow* rolling = arrays.rolling.empty() ? nullptr : arrays.rolling.data();
        const WallRow* wall = arrays.wall.empty() ? nullptr : arrays.wall.data();
        for (const std::size_t k : arrays.of_tile(tile))
            visit(arrays.contact[k], arrays.terms[k],
                SideRows{rolling ? rolling + k : nullptr, wall ? wall + k : nullptr}, is_wall);
    };
    visit_all(contacts.spheres, std::false_type{});
    visit_all(contacts.walls, std::true_type{});
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
