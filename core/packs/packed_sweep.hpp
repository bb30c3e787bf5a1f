// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/coulomb.hpp"
#include "core/packs/kernels.hpp"
#include "core/packs/numbers.hpp"
#include "core/world/solid_sphere.hpp"

/// The sweep on packs, METHOD (6) to (8), written once for registers of 2, 4 and 8 numbers: `width` contacts at a time.
namespace talus::packs
{

constexpr std::int32_t body_size = 8; ///< numbers of a Body

/// Of a lane that is not in use.
template <int width> constexpr double no_body[body_size] = {0, 0, 0, 0, 0, 0, 0, 1};

/// `width` bodies, number beside number. @tparam full no lane is empty
template <int width, bool full> struct Bodies {
    Numbers<width> number[body_size];

    [[gnu::always_inline]] void gather(const std::int32_t* body, const double* bodies)
    {
        const double* from[width];
#pragma GCC unroll 8
        for (int lane = 0; lane < width; ++lane)
            from[lane] = full || body[lane] >= 0 ? bodies + std::int64_t{body_size} * body[lane] : no_body<width>;
        packs::gather<width>(number, from);
    }
    [[gnu::always_inline]] void scatter(const std::int32_t* body, double* bodies)
    {
        double* to[width];
#pragma GCC unroll 8
        for (int lane = 0; lane < width; ++lane)
            to[lane] = full || body[lane] >= 0 ? bodies + std::int64_t{body_size} * body[lane] : nullptr;
        packs::scatter<width, body_size, full>(number, to);
    }
    [[gnu::always_inline]] Vector<width> velocity() const
    {
        return {number[0], number[1], number[2]};
    }
    [[gnu::always_inline]] Numbers<width> inverse_mass() const
    {
        return number[3];
    }
    [[gnu::always_inline]] Vector<width> rim_velocity() const
    {
        return {number[4], number[5], number[6]};
    }
    [[gnu::always_inline]] Numbers<width> spin_radius() const
    {
        return number[7];
    }
    [[gnu::always_inline]] void set_velocity(const Vector<width>& v)
    {
        number[0] = v.x;
        number[1] = v.y;
        number[2] = v.z;
    }
    [[gnu::always_inline]] void set_rim_velocity(const Vector<width>& a)
    {
        number[4] = a.x;
        number[5] = a.y;
        number[6] = a.z;
    }
};

/// Sums of each of the eight lanes, so that they do not depend on the width.
template <int width> struct Sums {
    Numbers<width> change[pack_size / width] = {}, size[pack_size / width] = {};

    [[gnu::always_inline]] SweepSums total() const
    {
        SweepSums sums;
        for (int group = 0; group < pack_size / width; ++group)
            for (int lane = 0; lane < width; ++lane) {
                sums.change += change[group][lane];
                sums.size += size[group][lane];
            }
        return sums;
    }
};

/// `width` contacts of a pack, from lane `first` on, and their bodies.
template <int width, bool wall, class R, bool full> struct Contacts {
    static constexpr bool spins = R::spin;

    ContactPack& pack;
    RollingPack* rolling;
    const WallPack* walls;
    double* bodies;
    int first;
    Bodies<width, full> a, b;
    Vector<width> normal;
    Numbers<width> arm_scale;

    /// @param p the pack; @param lane of it, the first; @param of_all all bodies
    [[gnu::always_inline]] Contacts(const PackSpan& packs, std::size_t p, double* of_all, int lane)
        : pack(packs.contact[p]), rolling(R::rolling ? packs.rolling + p : nullptr),
          walls(wall && R::moving_walls ? packs.wall + p : nullptr), bodies(of_all), first(lane)
    {
        a.gather(pack.a + first, bodies);
        if constexpr (!wall) b.gather(pack.b + first, bodies);
        normal = Vector<width>::load(pack.normal, first);
        arm_scale = load<width>(pack.arm_scale + first);
    }

    /// u = v_a − v_b + s n × (a_a + a_b), METHOD (3).
    [[gnu::always_inline]] Vector<width> velocity() const
    {
        Vector<width> u = a.velocity();
        if constexpr (!wall) u = u - b.velocity();
        if constexpr (wall && R::moving_walls) u = u - Vector<width>::load(walls->velocity, first);
        if constexpr (!spins) return u;
        Vector<width> rim = a.rim_velocity();
        if constexpr (!wall) rim = rim + b.rim_velocity();
        return u.plus_cross(normal * arm_scale, rim);
    }

    /// W
    [[gnu::always_inline]] Numbers<width> inverse_mass_sum() const
    {
        if constexpr (wall) return a.inverse_mass();
        return a.inverse_mass() + b.inverse_mass();
    }

    /// v ← v + M⁻¹ Gᵀ p.
    [[gnu::always_inline]] void apply(const Vector<width>& p)
    {
        a.set_velocity(a.velocity().plus(p, a.inverse_mass()));
        if constexpr (!wall) b.set_velocity(b.velocity().plus(p, -b.inverse_mass()));
        if constexpr (spins) {
            const Vector<width> turn = (normal * arm_scale).cross(p);
            a.set_rim_velocity(a.rim_velocity().plus(turn, -inverse_inertia_factor * a.inverse_mass()));
            if constexpr (!wall)
                b.set_rim_velocity(b.rim_velocity().plus(turn, -inverse_inertia_factor * b.inverse_mass()));
        }
    }

    /// Normal first, METHOD (6), then friction on the disk of the new normal impulse, (7).
    [[gnu::always_inline]] Vector<width> solved(const Vector<width>& impulse, double relaxation) const
    {
        const Vector<width> u = velocity();
        const Numbers<width> u_n = u.dot(normal), old_normal = impulse.dot(normal), none = {}, one = none + 1.0;
        const Numbers<width> mass = load<width>(pack.normal_mass + first);
        // (u_n + Σ λ_n − q)/(W + Σ), and Σ/(W + Σ) = 1 − W/(W + Σ).
        const Numbers<width> of_spring = fused<width>(
            u_n - load<width>(pack.target + first), mass, fused<width>(-inverse_mass_sum(), mass, one) * old_normal);
        Numbers<width> tangent_mass = load<width>(pack.tangent_mass + first), rigid_mass = tangent_mass;
        if constexpr (spins) // 1/W
            rigid_mass = fused<width>(inverse_inertia_factor * (arm_scale * arm_scale), tangent_mass, tangent_mass);
        const Numbers<width> of_parting = (u_n - load<width>(pack.parting + first)) * rigid_mass;
        const Numbers<width> wanted =
            fused<width>(none - relaxation, of_spring < of_parting ? of_parting : of_spring, old_normal);
        const Numbers<width> new_normal = wanted < 0.0 ? none : wanted;
        if constexpr (!R::friction) return normal * new_normal;
        tangent_mass = relaxation * tangent_mass;
        Vector<width> tangent = impulse.plus(u, -tangent_mass);
        tangent = tangent.plus(normal, fused<width>(u_n, tangent_mass, -old_normal));
        cut_to_disk<Numbers<width>>(tangent, load<width>(pack.friction + first) * new_normal);
        return tangent.plus(normal, new_normal);
    }

    /// Of a relative to b, or to the wall [rad/s].
    [[gnu::always_inline]] Vector<width> spin() const
    {
        Vector<width> spin = a.rim_velocity() * (1.0 / a.spin_radius());
        if constexpr (!wall) spin = spin - b.rim_velocity() * (1.0 / b.spin_radius());
        if constexpr (wall && R::moving_walls) spin = spin - Vector<width>::load(walls->spin, first);
        return spin;
    }

    /// Angular impulses of the rolling rows: at right angles to n, and along it.
    struct Turning {
        Vector<width> rolling;
        Numbers<width> twist;
    };
    [[gnu::always_inline]] Turning turning() const
    {
        return {Vector<width>::load(rolling->impulse, first), load<width>(rolling->twist + first)};
    }

    /// The rolling rows, METHOD (8). @param impulse of the contact as it stands
    [[gnu::always_inline]] Turning solved_rolling(const Vector<width>& impulse, double relaxation) const
    {
        const Vector<width> spin = this->spin();
        const Numbers<width> inertia = relaxation * load<width>(rolling->inertia + first), along = spin.dot(normal),
                             normal_impulse = impulse.dot(normal),
                             most = load<width>(rolling->twist_reach + first) * normal_impulse;
        Turning solved = turning();
        solved.rolling = solved.rolling - (spin - normal * along) * inertia;
        cut_to_disk<Numbers<width>>(solved.rolling, load<width>(rolling->reach + first) * normal_impulse);
        solved.twist = larger<Numbers<width>>(-most, smaller<Numbers<width>>(most, solved.twist - along * inertia));
        return solved;
    }

    /// ω ← ω + I⁻¹ τ.
    [[gnu::always_inline]] void apply_rolling(const Turning& turn)
    {
        const Vector<width> torque = turn.rolling + normal * turn.twist;
        a.set_rim_velocity(a.rim_velocity() + torque * (inverse_inertia_factor * a.inverse_mass() / a.spin_radius()));
        if constexpr (!wall)
            b.set_rim_velocity(
                b.rim_velocity() - torque * (inverse_inertia_factor * b.inverse_mass() / b.spin_radius()));
    }

    [[gnu::always_inline]] void put_back()
    {
        a.scatter(pack.a + first, bodies);
        if constexpr (!wall) b.scatter(pack.b + first, bodies);
    }

    template <bool apply_change> [[gnu::always_inline]] void relax(double relaxation, Sums<width>& sums)
    {
        const int group = first / width;
        const Numbers<width> weight = inverse_mass_sum();
        const Vector<width> impulse = Vector<width>::load(pack.impulse, first);
        const Vector<width> next = solved(impulse, relaxation), change = next - impulse;
        sums.change[group] = fused<width>(weight, change.dot(change), sums.change[group]);
        sums.size[group] = fused<width>(weight, next.dot(next), sums.size[group]);
        if constexpr (apply_change) {
            next.store(pack.impulse, first);
            apply(change);
        }
        if constexpr (R::rolling) {
            const Turning before = turning(), after = solved_rolling(apply_change ? next : impulse, relaxation);
            const Turning by{after.rolling - before.rolling, after.twist - before.twist};
            add_rolling(sums.change[group], by);
            add_rolling(sums.size[group], after);
            if constexpr (apply_change) {
                put(after);
                apply_rolling(by);
            }
        }
        if constexpr (apply_change) put_back();
    }

    [[gnu::always_inline]] void warm_start()
    {
        const Vector<width> impulse = Vector<width>::load(pack.impulse, first);
        apply(impulse);
        if constexpr (R::rolling) {
            apply_rolling(turning());
        }
        put_back();
    }

    /// Impulses grow by this share of what they are: λ ← (1 + share) λ, v ← v + M⁻¹ Gᵀ Δλ.
    [[gnu::always_inline]] void grow(const Numbers<width>& share)
    {
        const Vector<width> impulse = Vector<width>::load(pack.impulse, first), change = impulse * share;
        (impulse + change).store(pack.impulse, first);
        apply(change);
        if constexpr (R::rolling) {
            const Turning before = turning(), by{before.rolling * share, before.twist * share};
            put({before.rolling + by.rolling, before.twist + by.twist});
            apply_rolling(by);
        }
        put_back();
    }

private:
    [[gnu::always_inline]] void add_rolling(Numbers<width>& sum, const Turning& turn) const
    {
        const Numbers<width> inertia = load<width>(rolling->inertia + first);
        const Numbers<width> part = (turn.rolling.dot(turn.rolling) + turn.twist * turn.twist) / inertia;
        sum += inertia > 0.0 ? part : Numbers<width>{}; // 0 where a lane is empty
    }
    [[gnu::always_inline]] void put(const Turning& turn)
    {
        turn.rolling.store(rolling->impulse, first);
        store<width>(rolling->twist + first, turn.twist);
    }
};

constexpr std::size_t packs_ahead = 4;   ///< packs that are fetched into the cache before their turn
constexpr std::size_t spheres_ahead = 2; ///< packs whose spheres are

/// Asks for what the packs to come will need: beyond the second cache a sweep would wait for it most of its time.
template <bool wall, class R>
[[gnu::always_inline]] inline void prefetch(const PackSpan& packs, std::size_t p, const double* bodies)
{
    constexpr std::size_t line = 64;
    if (p + packs_ahead < packs.count) {
        const char* pack = reinterpret_cast<const char*>(packs.contact + p + packs_ahead);
        for (std::size_t at = 0; at < sizeof(ContactPack); at += line) __builtin_prefetch(pack + at, 1);
    }
    if (p + spheres_ahead < packs.count) {
        const ContactPack& pack = packs.contact[p + spheres_ahead];
        for (int lane = 0; lane < pack_size; ++lane) {
            __builtin_prefetch(bodies + std::int64_t{body_size} * pack.a[lane], 1);
            if constexpr (!wall) __builtin_prefetch(bodies + std::int64_t{body_size} * pack.b[lane], 1);
        }
    }
}

/// Calls visit(contacts) for all contacts of these packs, `width` at a time.
template <int width, bool wall, class R, class Visit>
[[gnu::always_inline]] inline void for_each_group(const PackSpan& packs, double* bodies, Visit visit)
{
    for (std::size_t p = 0; p < packs.count; ++p) {
        prefetch<wall, R>(packs, p, bodies);
        for (int first = 0; first < pack_size; first += width) {
            if (packs.contact[p].a[first + width - 1] >= 0)
                visit(Contacts<width, wall, R, true>(packs, p, bodies, first));
            else
                visit(Contacts<width, wall, R, false>(packs, p, bodies, first));
        }
    }
}

template <int width, class R, bool apply_change>
SweepSums relax(const PackSpan& spheres, const PackSpan& walls, double* bodies, double relaxation)
{
    Sums<width> sums;
    const auto visit = [&](auto contacts) __attribute__((always_inline))
    {
        contacts.template relax<apply_change>(relaxation, sums);
    };
    for_each_group<width, false, R>(spheres, bodies, visit);
    for_each_group<width, true, R>(walls, bodies, visit);
    return sums.total();
}

template <int width, class R> SweepSums measure(const PackSpan& spheres, const PackSpan& walls, double* bodies)
{
    return relax<width, R, false>(spheres, walls, bodies, 1.0);
}

template <int width, class R> void warm_start(const PackSpan& spheres, const PackSpan& walls, double* bodies)
{
    const auto visit = [&](auto contacts) __attribute__((always_inline))
    {
        contacts.warm_start();
    };
    for_each_group<width, false, R>(spheres, bodies, visit);
    for_each_group<width, true, R>(walls, bodies, visit);
}

template <int width, class R> constexpr SweepKernel sweep()
{
    return {relax<width, R, true>, measure<width, R>, warm_start<width, R>};
}

/// By Rows::index.
template <int width> constexpr std::array<SweepKernel, row_variants> sweeps()
{
    return {sweep<width, Rows<false, false, false, false>>(), sweep<width, Rows<false, false, false, true>>(),
        sweep<width, Rows<true, false, false, false>>(), sweep<width, Rows<true, false, false, true>>(),
        sweep<width, Rows<true, true, false, false>>(), sweep<width, Rows<true, true, false, true>>(),
        sweep<width, Rows<true, true, true, false>>(), sweep<width, Rows<true, true, true, true>>()};
}

} // namespace talus::packs
