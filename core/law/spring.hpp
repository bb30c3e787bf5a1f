// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/law_of_step.hpp"

/// The spring of a contact: how soft it is, what it stores, and what of it goes on to the next step.
///
/// Its compression κ is what of the overlap a load has pressed. It is stored as an energy, so that no step can take out
/// more than was put in: METHOD, energy.
namespace talus
{

/// Σ_n of a spring as stiff as N_min sweeps can carry.
template <class N> [[gnu::always_inline]] inline N carried_compliance(const N& inverse_mass_sum, const LawOfStep& step)
{
    return sigma_per_sweep / step.min_sweeps * inverse_mass_sum;
}

/// Σ_n of a spring: that of the material's stiffness k, but no stiffer than sweeps can carry.
template <class N>
[[gnu::always_inline]] inline N spring_compliance(const N& stiffness, const N& inverse_mass_sum, const LawOfStep& step)
{
    return larger<N>(4.0 * upsilon / (stiffness * step.h * step.h), carried_compliance<N>(inverse_mass_sum, step));
}

/// What a sub-step takes of the feedback on κ. The stiffness that sweeps can carry goes with 1/h², so with all of it a
/// bed at rest would rise when its step is split: springs keep the stiffness of the whole step.
template <class N>
[[gnu::always_inline]] inline N feedback_share(const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    if (step.parts == 1.0) return N{} + 1.0;
    const double parts_squared = step.parts * step.parts;
    return smaller<N>(N{} + 1.0, compliance / (parts_squared * sigma_per_sweep / step.min_sweeps * inverse_mass_sum));
}

/// What of a spring's energy is in its motion, as the square of a length [m²].
template <class N>
[[gnu::always_inline]] inline N moving_part(
    const N& u_n, const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    constexpr double per_share = 1.0 / (8.0 * upsilon);
    const N way = step.h * u_n;
    if (step.parts == 1.0) return (per_share - 0.25) * (way * way);
    return way * way * (per_share / feedback_share<N>(compliance, inverse_mass_sum, step) - 0.25);
}

/// What a spring stores, as the square of a length [m²]: κ² + h κ u_n + h² u_n²/(8 Υ share).
template <class N>
[[gnu::always_inline]] inline N spring_square(
    const N& kappa, const N& u_n, const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    const N middle = kappa + 0.5 * step.h * u_n;
    return middle * middle + moving_part<N>(u_n, compliance, inverse_mass_sum, step);
}

/// The energy of a spring [J], by the square of that length: ½ k (κ² + h κ u_n) + u_n²/(4 Σ_n) with
/// k = 4 Υ share/(Σ_n h²). With this a loaded spring beside any other contacts adds −(u_n⁺ + u_n)²/(4 Σ_n) to the
/// energy of a step (METHOD, energy).
template <class N>
[[gnu::always_inline]] inline N energy_of_square(
    const N& square, const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    const double per_square = 2.0 * upsilon / (step.h * step.h);
    return per_square * feedback_share<N>(compliance, inverse_mass_sum, step) * square / compliance;
}

/// What κ a spring may begin with whose row is rigid, so that it comes to hold no more than it did.
template <class N>
[[gnu::always_inline]] inline N borne_compression(const N& kappa, const N& u_n, const LawOfStep& step)
{
    const N kept = kappa + 0.5 * step.h * smaller<N>(N{}, u_n);
    return kept > 0.0 ? kept : N{} - __builtin_inf();
}

/// κ after a step at this speed, while it is not negative. What was compressed faster than impacts begin, e has a part
/// in: it gives way 1/e² as fast (Walton & Braun 1986); pushing out is no part of that speed.
/// @param gap at the beginning of the step [m]
template <class N>
[[gnu::always_inline]] inline N compression_after(
    const N& kappa, const N& gap, const N& u_n, const N& restitution, const LawOfStep& step)
{
    N gives_way = {};
    if (any_of(u_n > step.elastic_speed)) {
        const N pushing = smaller<N>(N{} + step.push_out_speed, (-gap - kappa) / step.h);
        const N fast = larger<N>(N{}, u_n - step.elastic_speed - larger<N>(N{}, pushing));
        const N e = larger<N>(N{} + least_restitution, restitution);
        gives_way = fast * larger<N>(N{}, 1.0 / (e * e) - 1.0);
    }
    return kappa - step.h * (u_n + gives_way);
}

/// What a contact hands on of its spring is what that stores, as the square of a length: when a curved wall turns the
/// normal, u_n changes, and the next step makes that κ of it which stores as much. A spring that had no load in the
/// step stores what it did, and has lost no more of its κ than it has opened. 0: there is no spring, or none could hold
/// so little.
/// @param stored at the beginning of the step [m²]
template <class N>
[[gnu::always_inline]] inline N handed_on(const N& kappa_after, const N& stored, const N& u_n, const N& impulse,
    const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    const N square = spring_square<N>(kappa_after, u_n, compliance, inverse_mass_sum, step);
    const N loaded = kappa_after > touching_gap * step.min_diameter ? square : N{};
    return impulse > 0.0 ? loaded : stored;
}

/// The κ with which a step begins, of what the step before has handed on.
/// @param handed the root of that [m]; @param loaded in the step before
template <class N>
[[gnu::always_inline]] inline N taken_over(const N& handed, const Answer<N>& loaded, const N& gap, const N& u_n,
    const N& restitution, const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    const N left = handed * handed - moving_part<N>(u_n, compliance, inverse_mass_sum, step);
    const N most = root<N>(larger<N>(N{}, left)) - 0.5 * step.h * u_n;
    const N kappa = loaded ? most : smaller<N>(most, compression_after<N>(handed, gap, u_n, restitution, step));
    return ((handed > 0.0) & (left > 0.0)) ? kappa : N{};
}

} // namespace talus
