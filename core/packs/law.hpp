// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/contact_pack.hpp"

/// The laws of a contact, METHOD (4), for one (N a double) or for as many as a register holds: what is not asked for is
/// worked out as well, and left aside.
namespace talus
{

/// Υ = 1/(1 + 4τ/h) at τ = 2h, the critical damping of the note's step: a bilateral
/// error g₀ decays as g₀ (1 + 2k/3) 3⁻ᵏ over k steps.
inline constexpr double upsilon = 1.0 / 9.0;

/// σ N_min of `matched`: the softest normal compliance, in inverse mass sums, at which N_min warm-started sweeps
/// neither boil nor creep. Measured in beds, columns and heaps: σ N = 0.2 is clean, 0.1 restless, 0.05 creeps, 0 boils.
inline constexpr double sigma_per_sweep = 0.2;

/// Share of an overlap that one position pass of `projected` removes: that of the note's step, 4Υ.
inline constexpr double projected_share = 4.0 * upsilon;

/// What the laws of all contacts of a step share.
struct LawOfStep {
    double h;                                ///< of this step or sub-step [s]
    double h_before = h;                     ///< of the one before [s]
    double threshold_speed = 0.0;            ///< slowest impact: that of the whole step [m/s]
    bool rigid = false;                      ///< `projected`
    double min_sweeps = 2.0;                 ///< N_min
    double push_out_speed = __builtin_inf(); ///< p [m/s]
    double parts = 1.0;                      ///< sub-steps of the whole step
    double shallow_overlap = 0.0;            ///< of StepLength [m]
};

/// Yes or no for each of these numbers.
template <class N> using Answer = decltype(N{} < N{});

/// The normal law u_n + Σ_n λ_n ≥ q_n of one contact.
template <class N> struct NormalLaw {
    N target;         ///< q_n [m/s]
    N compliance;     ///< Σ_n [1/kg]
    N feedback_share; ///< of the feedback on κ, and so of the stiffness 4Υ/(Σ_n h²), that it takes
};

/// What the law of a contact depends on.
template <class N> struct ContactEvent {
    Answer<N> impact, open; ///< its kind; else it rests
    N gap;                  ///< g, of a resting contact −κ, with the compression κ of its spring [m]
    N u_n;                  ///< of v⁽⁰⁾, before gravity [m/s]
    N inverse_mass_sum;     ///< W [1/kg]
    N restitution;          ///< e
    N stiffness;            ///< k [N/m]
    Answer<N> jammed = {};  ///< TouchRecord
    N u_n_turned = {};      ///< what the turn of a wall's normal since the step before has added to u_n [m/s]
};

template <class N> [[gnu::always_inline]] inline N smaller(const N& a, const N& b)
{
    return b < a ? b : a;
}

template <class N> [[gnu::always_inline]] inline N larger(const N& a, const N& b)
{
    return a < b ? b : a;
}

/// Σ_n of a resting contact of `matched`: that of the material's stiffness k, but no stiffer than N_min sweeps can
/// carry.
template <class N>
[[gnu::always_inline]] inline N matched_compliance(
    const N& stiffness, const N& inverse_mass_sum, double h, double min_sweeps)
{
    return larger<N>(4.0 * upsilon / (stiffness * h * h), sigma_per_sweep / min_sweeps * inverse_mass_sum);
}

/// What a spring of the stiffness that a compliance stands for, k = 4 Υ / (Σ_n h²), holds at the compression κ [J].
template <class N> [[gnu::always_inline]] inline N spring_energy(const N& kappa, const N& compliance, double h)
{
    return 2.0 * upsilon / (compliance * h * h) * kappa * kappa;
}

/// The compression κ of a contact's spring: how much of its overlap a load has pressed [m]. What an impact leaves
/// overlapping, or closes beside it, has stored nothing, and must not push as if it had. It becomes compression with
/// the push-out speed p, so that a deep overlap does not become a shot.
/// @param before κ of the step before, not read where the contact was not loaded in it; @param u_n of v⁽⁰⁾, against
/// the wall's velocity then
template <class N>
[[gnu::always_inline]] inline N compression(
    const N& gap, const N& before, const N& u_n, const Answer<N>& was_loaded, const LawOfStep& step)
{
    const N depth = larger<N>(N{}, -gap);
    const N borne = was_loaded ? larger<N>(N{}, before - step.h_before * u_n) : N{};
    return smaller<N>(depth, borne + step.h * step.push_out_speed);
}

/// What a sub-step takes of the feedback on κ. The stiffness that sweeps can carry goes with 1/h², so with all of it a
/// bed at rest would rise when its step is split. Contacts that are little compressed keep the stiffness of the whole
/// step, and those with five times that κ have that of the sub-step.
template <class N> [[gnu::always_inline]] inline N feedback_share(const ContactEvent<N>& event, const LawOfStep& step)
{
    const N one = N{} + 1.0;
    const N in_part = matched_compliance<N>(event.stiffness, event.inverse_mass_sum, step.h, step.min_sweeps);
    const N in_whole =
        matched_compliance<N>(event.stiffness, event.inverse_mass_sum, step.parts * step.h, step.min_sweeps);
    const N as_stiff = in_part / (in_whole * step.parts * step.parts);
    const N deep = smaller<N>(one, larger<N>(N{}, (-event.gap / step.shallow_overlap - 1.0) / 4.0));
    return as_stiff + deep * (1.0 - as_stiff);
}

/// What a rigid contact at a concave wall gives back of the velocity that it takes. A sphere that runs along it goes on
/// chords: the turn of the normal makes it meet the wall with u_n < 0 in every step, and u_n ≥ 0 would brake it. With
/// half of the turn against each end of a chord its speed is kept. Never more than it came with.
template <class N> [[gnu::always_inline]] inline N turned_back(const ContactEvent<N>& event)
{
    return larger<N>(N{}, smaller<N>(-event.u_n, -0.5 * event.u_n_turned));
}

/// `matched` (the default): the note's own step, eq. (2), with a compliance that the sweeps can carry. A jammed contact
/// parts with the push-out speed at most, and stores nothing.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> matched_law(const ContactEvent<N>& event, const LawOfStep& step)
{
    const N compliance = matched_compliance<N>(event.stiffness, event.inverse_mass_sum, step.h, step.min_sweeps);
    const N share = step.parts > 1.0 ? feedback_share<N>(event, step) : N{} + 1.0;
    const N push_out = -4.0 / step.h * upsilon * event.gap;
    const N yielding = smaller<N>(push_out, N{} + step.push_out_speed);
    return {event.jammed ? yielding : share * push_out + upsilon * event.u_n, compliance, event.jammed ? N{} : share};
}

/// `projected`: rigid, u_n ≥ 0; overlap is removed by moving the spheres (position_projection.hpp). A jammed contact
/// yields: it has an impulse in proportion to the speed with which it is closed, and none when it is not.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> projected_law(const ContactEvent<N>& event, const LawOfStep& step)
{
    const N compliance = matched_compliance<N>(event.stiffness, event.inverse_mass_sum, step.h, step.min_sweeps);
    return {event.jammed ? N{} : turned_back<N>(event), event.jammed ? compliance : N{}, N{}};
}

/// The law of a contact by its kind: METHOD (4).
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> normal_law(const ContactEvent<N>& event, const LawOfStep& step)
{
    const NormalLaw<N> resting = step.rigid ? projected_law<N>(event, step) : matched_law<N>(event, step);
    const N impact = -event.restitution * event.u_n;
    const N open = step.rigid ? -event.gap / step.h + turned_back<N>(event) : -event.gap / step.h;
    return {event.impact ? impact : (event.open ? open : resting.target),
        (event.impact | event.open) ? N{} : resting.compliance, resting.feedback_share};
}

/// When two spheres that move so touch: infinite if never, negative if they overlap and approach [s].
/// @param approach −Δx·Δv; @param speed_squared of Δv; @param apart |Δx|² − (r_a + r_b)²;
/// @param root_of the root of a number, of 0 where it is negative
template <class N, class Root>
[[gnu::always_inline]] inline N closing_time(const N& approach, const N& speed_squared, const N& apart, Root root_of)
{
    const N square = approach * approach - speed_squared * apart;
    const N closes = apart / (approach + root_of(larger<N>(N{}, square)));
    return ((approach > 0.0) & (square >= 0.0)) ? closes : N{} + __builtin_inf();
}

/// Whether a contact is an impact in this step.
/// @param closes when the gap does so by itself [s]; @param loaded in the step before it had an impulse
template <class N>
[[gnu::always_inline]] inline Answer<N> is_impact(
    const N& gap, const N& u_n, const N& closes, const Answer<N>& loaded, const N& restitution, const LawOfStep& step)
{
    const Answer<N> fast = (restitution > 0.0) & (u_n < N{} - step.threshold_speed);
    return fast & (((gap <= 0.0) & (!loaded)) | ((gap > 0.0) & (closes < N{} + step.h)));
}

} // namespace talus
