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

/// Spheres touch up to this gap, and a spring exists from this compression on, in smallest diameters: no decision
/// hangs on rounding.
inline constexpr double touching_gap = 1e-9;

/// A load below this share of an impact's impulse is none.
inline constexpr double load_share = 1e-4;

/// A spring gives way no faster than with this restitution: with a smaller one, it parts slowly.
inline constexpr double least_restitution = 0.25;

/// An impact below this share of a contact's load is light: the contact stays a spring beside it.
inline constexpr double light_share = 0.1;

/// A contact that overlaps more than this yields, in reduced radii R*: it holds no more than what has pressed it so
/// far. What strains a contact is the root of overlap over R* (Hertz).
inline constexpr double yield_overlap = 0.05;
/// For reports alone, in smallest diameters: what comes deeper for many steps beyond the first (with `projected` beyond
/// where contacts yield), or twice beyond the second, has jammed, until it is shallower than the third.
inline constexpr double pressed_overlap = 0.05;
inline constexpr double jamming_overlap = 0.25;
inline constexpr double jammed_overlap = 0.01;

/// Rigid contacts get softer with the fourth power of their overlap, up to this, in diameters of the smaller sphere,
/// and up to this compliance, in inverse mass sums.
inline constexpr double rigid_yield_overlap = 0.016;
inline constexpr double rigid_softness = 0.02;

/// What sweeps may leave undone of the load of a rigid contact.
inline constexpr double undone_share = 0.03;

/// Nearer to the centre of the smaller sphere than this a contact gets stiffer, up to the second; in its diameters.
inline constexpr double stiffening_rest = 0.25;
inline constexpr double least_rest = 3e-2;

/// Overlap up to which a contact is deferred beside an impact, in diameters of the smaller sphere.
inline constexpr double deferred_overlap = 0.4;

/// What the laws of all contacts of a step share.
struct LawOfStep {
    double h;                     ///< of this step or sub-step [s]
    double threshold_speed = 0.0; ///< slowest impact: that of the whole step [m/s]
    double elastic_speed = 0.0;   ///< opening so, a spring gives back all that it holds [m/s]
    bool rigid = false;           ///< `projected`
    double min_sweeps = 2.0;      ///< N_min
    double push_out_speed = 0.0;  ///< p [m/s]
    double parts = 1.0;           ///< sub-steps of the whole step
    double min_diameter = 0.0;    ///< d_min [m]
};

/// Yes or no for each of these numbers.
template <class N> using Answer = decltype(N{} < N{});

/// The normal law of one contact: 0 ≤ λ_n ⟂ u_n − min(q_n − Σ_n λ_n, parting) ≥ 0.
template <class N> struct NormalLaw {
    N target;      ///< q_n [m/s]
    N compliance;  ///< Σ_n [1/kg]
    N parting;     ///< at most it asks for [m/s]
    N compression; ///< κ: what a load has pressed, and pushing out [m] …
    N grown;       ///< … in this step [m]
    N push;        ///< what it may put in by pushing out, by its impulse; that of a spring is in its store [m/s]
    Answer<N> yields;
};

/// What the law of a contact depends on.
template <class N> struct ContactEvent {
    N gap;            ///< g [m]
    N diameter;       ///< of the smaller sphere [m]
    N reduced_radius; ///< R* = r_a r_b/(r_a + r_b); at a wall r_a [m]
    N u_n;            ///< of v⁽⁰⁾, before gravity [m/s] …
    N u_n_before;     ///< … against the velocity that the wall had in the step before: 0 where a sphere goes with it
    N closes;         ///< when the gap does so, with v⁽¹⁾ [s]
    N inverse_mass_sum; ///< W [1/kg]
    N restitution;      ///< e
    N stiffness;        ///< k [N/m]
    N load;             ///< λ_n that the step before would have had, had it been whole [N s] …
    N compression;      ///< … and the κ that it has left [m]
    Answer<N> struck;   ///< it was an impact then
};

/// Whether it is so for one of them at least: what only these need is not worked out for none.
template <class A> [[gnu::always_inline]] inline bool any_of(const A& answer)
{
    if constexpr (sizeof(A) == sizeof(bool)) {
        return answer;
    } else {
        bool any = false;
        for (std::size_t lane = 0; lane < sizeof(A) / sizeof answer[0]; ++lane) any |= answer[lane] != 0;
        return any;
    }
}

template <class N> [[gnu::always_inline]] inline N smaller(const N& a, const N& b)
{
    return b < a ? b : a;
}

template <class N> [[gnu::always_inline]] inline N larger(const N& a, const N& b)
{
    return a < b ? b : a;
}

/// Σ_n of a spring: that of the material's stiffness k, but no stiffer than N_min sweeps can carry.
template <class N>
[[gnu::always_inline]] inline N spring_compliance(const N& stiffness, const N& inverse_mass_sum, const LawOfStep& step)
{
    return larger<N>(
        4.0 * upsilon / (stiffness * step.h * step.h), sigma_per_sweep / step.min_sweeps * inverse_mass_sum);
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

/// What a spring holds, as the square of a length [m²]: κ² + h κ u_n + h² u_n²/(8 Υ share).
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

/// Whether spheres touch already, but for rounding.
template <class N> [[gnu::always_inline]] inline Answer<N> touches(const N& gap, const LawOfStep& step)
{
    return gap <= N{} + touching_gap * step.min_diameter;
}

/// The impulse that an impact by itself would have [N s].
template <class N> [[gnu::always_inline]] inline N impact_size(const ContactEvent<N>& event)
{
    return (1.0 + event.restitution) * larger<N>(N{}, -event.u_n) / event.inverse_mass_sum;
}

/// By how much a contact overlaps when it begins to yield [m].
template <class N> [[gnu::always_inline]] inline N elastic_overlap(const ContactEvent<N>& event, const LawOfStep& step)
{
    return step.rigid ? rigid_yield_overlap * event.diameter : yield_overlap * event.reduced_radius;
}

/// Σ_n of a rigid contact: so small where it is shallow that nobody sees it, but where walls leave too little room,
/// impulses that no velocity obeys do not grow with every sweep. What W + Σ rounds away is 0.
template <class N> [[gnu::always_inline]] inline N rigid_compliance(const ContactEvent<N>& event)
{
    const N part = smaller<N>(N{} + 1.0, -event.gap / (rigid_yield_overlap * event.diameter)), square = part * part;
    const N w = event.inverse_mass_sum;
    return w + rigid_softness * square * square * w - w;
}

/// How many times stiffer a contact is that yields: none is as deep as the centre of its smaller sphere.
template <class N> [[gnu::always_inline]] inline N stiffening(const ContactEvent<N>& event)
{
    if (!any_of(-event.gap > (0.5 - stiffening_rest) * event.diameter)) return N{} + 1.0;
    const N rest = larger<N>(N{} + least_rest, 0.5 + event.gap / event.diameter);
    const N growth = larger<N>(N{} + 1.0, stiffening_rest / rest);
    return growth * growth;
}

/// Whether a contact is an impact in this step: it closes, faster than gravity alone would have it, and has no load.
/// What impacts have not stopped before it is as deep as a deferred one may be, yields; and what has been an impact,
/// touches and would part again with less than the slowest impact, rests.
template <class N>
[[gnu::always_inline]] inline Answer<N> is_impact(const ContactEvent<N>& event, const LawOfStep& step)
{
    const Answer<N> closes = touches<N>(event.gap, step) | (event.closes < N{} + step.h);
    const Answer<N> settles =
        touches<N>(event.gap, step) & (-event.restitution * event.u_n < N{} + step.threshold_speed);
    const Answer<N> unstopped = (-event.gap > deferred_overlap * event.diameter) | (event.struck & settles);
    const N change = (1.0 + event.restitution) * -event.u_n; // of u_n, by an impact
    return (event.u_n < N{} - step.threshold_speed) & closes &
           (event.load * event.inverse_mass_sum < load_share * change) & (!unstopped);
}

/// The target of a row that has no spring. A rigid row adds ½ λ_n (u_n⁺ + u_n) to the energy of a step, whatever other
/// contacts do: nothing, if it asks for no more than −u_n, and no more than λ_n times the push, if it pushes.
template <class N> [[gnu::always_inline]] inline N passive_target(const N& push, const N& u_n)
{
    return smaller<N>(push, 2.0 * larger<N>(N{}, push) - u_n);
}

/// The speed at which an overlap is pushed out [m/s].
template <class N> [[gnu::always_inline]] inline N push_of(const N& overlap, const LawOfStep& step)
{
    return larger<N>(N{}, smaller<N>(N{} + step.push_out_speed, overlap * (4.0 * upsilon / step.h)));
}

/// How fast a rigid contact that touches is pushed out beside what it asks for: by what sweeps leave undone of its
/// load, so that it does not sink.
template <class N> [[gnu::always_inline]] inline N rigid_push(const ContactEvent<N>& event, const LawOfStep& step)
{
    return smaller<N>(push_of<N>(-event.gap, step), undone_share * event.inverse_mass_sum * event.load);
}

/// The speed at which a loaded contact parts however little its restitution is: without it, beds boil.
inline double slow_parting(const LawOfStep& step)
{
    return step.elastic_speed / 3.0;
}

/// How fast a spring parts at most: what was pressed faster than impacts begin comes back with e of the speed that it
/// could have; κ/h is more than any spring has. A contact that does so gives energy away only where it does not close,
/// so it may always part as fast as it has closed.
template <class N>
[[gnu::always_inline]] inline N spring_parting(const ContactEvent<N>& event, const N& kappa, const LawOfStep& step)
{
    return larger<N>(slow_parting(step) + event.restitution * kappa * (1.0 / step.h), -event.u_n_before);
}

/// The law of a contact of `projected`: rigid, but the softer the more it overlaps. It bears as a spring that all of
/// its overlap has pressed, so that no load sinks, and parts no faster than it would alone.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> rigid_law(const ContactEvent<N>& event, const LawOfStep& step)
{
    const N none = {}, infinite = none + __builtin_inf();
    const Answer<N> open = !touches<N>(event.gap, step), yields = -event.gap > elastic_overlap<N>(event, step);
    const N push = rigid_push<N>(event, step), alone = smaller<N>(none, 2.0 * push - event.u_n_before);
    const N strength = -event.gap * (4.0 * upsilon / step.h);
    return {open ? passive_target<N>(-event.gap * (1.0 / step.h), event.u_n_before) : larger<N>(alone, strength),
        open ? none : rigid_compliance<N>(event) / stiffening<N>(event), open ? infinite : alone, none - infinite, none,
        open ? none : push, yields};
}

/// What κ a spring may begin with whose row is rigid, so that it comes to hold no more than it did.
template <class N>
[[gnu::always_inline]] inline N borne_compression(const N& kappa, const N& u_n, const LawOfStep& step)
{
    const N kept = kappa + 0.5 * step.h * smaller<N>(N{}, u_n);
    return kept > 0.0 ? kept : N{} - __builtin_inf();
}

/// The law of a contact of `matched`: a spring where a load has pressed it. What yields bears as one that all of its
/// overlap has pressed, and forgets: the deeper it is, the less of its spring is left, and it parts with the speed of
/// what is loaded times its strain, no faster than impacts begin.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> spring_law(const ContactEvent<N>& event, const LawOfStep& step)
{
    const N none = {}, infinite = none + __builtin_inf(), least = none + touching_gap * step.min_diameter;
    const N compliance = spring_compliance<N>(event.stiffness, event.inverse_mass_sum, step);
    const N share = feedback_share<N>(compliance, event.inverse_mass_sum, step);
    const N per_way = 4.0 * upsilon / step.h * share; // of feedback: the speed that it asks for, by κ

    const N most = elastic_overlap<N>(event, step);
    const Answer<N> open = event.gap > least, touching = event.gap <= least, yields = -event.gap > most;
    const N before = event.compression > least ? event.compression : none;
    N strain = none + 1.0, presses = -event.gap;
    if (any_of(yields)) {
        strain = -event.gap / most;
        presses = yields ? most / strain : presses;
    }
    const N elastic = smaller<N>(presses, before);
    const N grown = smaller<N>(presses - elastic, none + step.h * step.push_out_speed), kappa = elastic + grown;
    const Answer<N> is_spring = touching & (before > 0.0), closes = touching & (event.u_n_before < least / step.h);
    const N kept = yields ? borne_compression<N>(kappa, event.u_n_before, step) : kappa;
    const Answer<N> keeps = is_spring | closes;

    const N feedback = per_way * kappa, strength = per_way * -event.gap;
    const N most_pushing = none + smaller(step.push_out_speed, step.elastic_speed);
    const N pushing = smaller<N>(smaller<N>(most_pushing, slow_parting(step) * strain), strength);
    const N asks = open ? -event.gap * (1.0 / step.h) : (yields ? pushing : feedback);
    const N alone = passive_target<N>(asks, event.u_n_before);
    const N parting = is_spring ? spring_parting<N>(event, kappa, step) : infinite;
    return {yields ? larger<N>(alone, strength) : (is_spring ? feedback : alone),
        yields ? compliance / stiffening<N>(event) : compliance, yields ? alone : parting, keeps ? kept : -infinite,
        grown, (open | (keeps & !yields)) ? none : asks, yields};
}

/// The law of a contact where no impact is beside it, METHOD (4).
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> normal_law(
    const ContactEvent<N>& event, const Answer<N>& impact, const LawOfStep& step)
{
    const N none = {}, infinite = none + __builtin_inf();
    const NormalLaw<N> law = step.rigid ? rigid_law<N>(event, step) : spring_law<N>(event, step);
    return {impact ? -event.restitution * event.u_n : law.target, impact ? none : law.compliance,
        impact ? infinite : law.parting, impact ? -infinite : law.compression, law.grown, impact ? none : law.push,
        law.yields & !impact};
}

/// A contact that had no load beside an impact of one of its spheres is deferred: it does not close further than to
/// `deferred_overlap`, and in the next step it is an impact of its own.
inline double deferred_target(double gap, double u_n, const LawOfStep& step)
{
    return smaller(-(gap + deferred_overlap * step.min_diameter) / step.h, -u_n);
}

/// A contact that has a load beside an impact of one of its spheres bears it: it is rigid.
inline double bearing_target(double gap, double u_n, const LawOfStep& step)
{
    return smaller(-larger(0.0, gap) / step.h, -u_n);
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

/// What a contact hands on of its spring is what that holds, as the square of a length: when a curved wall turns the
/// normal, u_n changes, and the next step makes that κ of it which holds as much. A spring that had no load in the step
/// holds what it did, and has lost no more of its κ than it has opened. 0: there is no spring, or none could hold so
/// little.
/// @param held at the beginning of the step [m²]
template <class N>
[[gnu::always_inline]] inline N handed_on(const N& kappa_after, const N& held, const N& u_n, const N& impulse,
    const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    const N square = spring_square<N>(kappa_after, u_n, compliance, inverse_mass_sum, step);
    const N loaded = kappa_after > touching_gap * step.min_diameter ? square : N{};
    return impulse > 0.0 ? loaded : held;
}
/// @param handed the root of what was handed on [m]; @param loaded in the step before
/// @param root_of the root of a number
template <class N, class Root>
[[gnu::always_inline]] inline N taken_over(const N& handed, const Answer<N>& loaded, const N& gap, const N& u_n,
    const N& restitution, const N& compliance, const N& inverse_mass_sum, const LawOfStep& step, Root root_of)
{
    const N left = handed * handed - moving_part<N>(u_n, compliance, inverse_mass_sum, step);
    const N most = root_of(larger<N>(N{}, left)) - 0.5 * step.h * u_n;
    const N kappa = loaded ? most : smaller<N>(most, compression_after<N>(handed, gap, u_n, restitution, step));
    return ((handed > 0.0) & (left > 0.0)) ? kappa : N{};
}

/// u_n⁺ of a solved row, by its impulse [m/s].
template <class N>
[[gnu::always_inline]] inline N solved_velocity(
    const N& target, const N& compliance, const N& parting, const N& impulse)
{
    return smaller<N>(target - compliance * impulse, parting);
}

} // namespace talus
