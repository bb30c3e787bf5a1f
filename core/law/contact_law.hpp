// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/spring.hpp"

#include <cstdint>

/// The law of a contact, METHOD (4): a function for each row of its table. What is different beside impacts stands in
/// impact.hpp.
namespace talus
{

/// Law that a contact follows in this step.
enum class ContactKind : std::uint8_t { resting, open, impact, yielding, bearing, deferred };

/// The normal law of one contact: 0 ≤ λ_n ⟂ u_n − min(q_n − Σ_n λ_n, parting) ≥ 0.
template <class N> struct NormalLaw {
    N target;      ///< q_n [m/s]
    N compliance;  ///< Σ_n [1/kg]
    N parting;     ///< at most it asks for [m/s]
    N compression; ///< κ: what a load has pressed, and pushing out [m]; −∞: it will keep none
    N grown;       ///< by how much pushing out has made κ larger in this step [m]
    N push;        ///< what it may put in by pushing out, by its impulse; that of a spring is in its store [m/s]
};

/// u_n⁺ of a solved row, by its impulse [m/s].
template <class N>
[[gnu::always_inline]] inline N solved_velocity(
    const N& target, const N& compliance, const N& parting, const N& impulse)
{
    return smaller<N>(target - compliance * impulse, parting);
}

/// What the law of a contact depends on.
template <class N> struct ContactEvent {
    N gap;            ///< g [m]
    N diameter;       ///< of the smaller sphere [m]
    N reduced_radius; ///< R* = r_a r_b/(r_a + r_b); at a wall r_a [m]
    N u_n;            ///< of v⁽⁰⁾, before gravity [m/s]
    N u_n_before; ///< of v⁽⁰⁾, against the velocity that the wall had in the step before: 0 where a sphere goes with it
    N closes;           ///< when the gap does so, with v⁽¹⁾ [s]
    N inverse_mass_sum; ///< W [1/kg]
    N restitution;      ///< e
    N stiffness;        ///< k [N/m]
    N load;             ///< λ_n that the step before would have had, had it been whole [N s]
    N compression;      ///< the κ that the step before has left [m]
    Answer<N> struck;   ///< it was an impact in the step before
    N shift = {};       ///< of the overlap its spring has no part: StepSpring [m]
    N full_shift = {};  ///< … if all of that had pressed it [m]
};

/// Whether spheres touch already, but for rounding.
template <class N> [[gnu::always_inline]] inline Answer<N> touches(const N& gap, const LawOfStep& step)
{
    return gap <= N{} + touching_gap * step.min_diameter;
}

/// What of the overlap can have pressed its spring [m].
template <class N> [[gnu::always_inline]] inline N springy_overlap(const ContactEvent<N>& event)
{
    return -event.gap - event.shift;
}

/// By how much a contact overlaps when it begins to yield [m].
template <class N> [[gnu::always_inline]] inline N elastic_overlap(const ContactEvent<N>& event, const LawOfStep& step)
{
    return step.rigid ? rigid_yield_overlap * event.diameter : yield_overlap * event.reduced_radius;
}

/// Whether it overlaps by more: then it yields, unless it is an impact.
template <class N>
[[gnu::always_inline]] inline Answer<N> overstrained(const ContactEvent<N>& event, const LawOfStep& step)
{
    return -event.gap > elastic_overlap<N>(event, step);
}

/// The target of a row that has no spring. A rigid row adds ½ λ_n (u_n⁺ + u_n) to the energy of a step, whatever other
/// contacts do: nothing, if it asks for no more than −u_n, and no more than λ_n times the push, if it pushes.
template <class N> [[gnu::always_inline]] inline N passive_target(const N& push, const N& u_n)
{
    return smaller<N>(push, 2.0 * larger<N>(N{}, push) - u_n);
}

/// The speed with which a loaded contact parts however little its restitution is: without it, beds boil.
template <class N> [[gnu::always_inline]] inline N slow_parting(const LawOfStep& step)
{
    return N{} + step.elastic_speed / 3.0;
}

/// How many times stiffer a contact is that yields: none is as deep as the centre of its smaller sphere.
template <class N> [[gnu::always_inline]] inline N stiffening(const ContactEvent<N>& event)
{
    if (!any_of(-event.gap > (0.5 - stiffening_rest) * event.diameter)) return N{} + 1.0;
    const N rest = larger<N>(N{} + least_rest, 0.5 + event.gap / event.diameter);
    const N growth = larger<N>(N{} + 1.0, stiffening_rest / rest);
    return growth * growth;
}

/// It parts with e of the speed with which it closes.
template <class N> [[gnu::always_inline]] inline NormalLaw<N> impact_law(const ContactEvent<N>& event)
{
    const N none = {}, infinite = none + __builtin_inf();
    return {-event.restitution * event.u_n, none, infinite, -infinite, none, none};
}

/// Its gap may close, and no further: that is as soft as the spring that it is to be.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> open_law(
    const ContactEvent<N>& event, const N& compliance, const LawOfStep& step)
{
    const N none = {}, infinite = none + __builtin_inf();
    return {
        passive_target<N>(-event.gap * (1.0 / step.h), event.u_n_before), compliance, infinite, -infinite, none, none};
}

/// What κ a step begins with, of an overlap of which a load can have pressed so much: that of the step before, and what
/// pushing out adds.
template <class N> struct Compression {
    N kappa, grown;

    [[gnu::always_inline]] Compression(const N& overlap, const N& before, const LawOfStep& step)
    {
        const N elastic = smaller<N>(overlap, before);
        grown = smaller<N>(overlap - elastic, N{} + step.h * step.push_out_speed);
        kappa = elastic + grown;
    }
};

/// Whether a contact that has no spring yet keeps the κ of this step: not if it parts.
template <class N>
[[gnu::always_inline]] inline Answer<N> begins_spring(const ContactEvent<N>& event, const LawOfStep& step)
{
    return event.u_n_before < N{} + touching_gap * step.min_diameter / step.h;
}

/// It touches: a spring where a load has pressed it. What was pressed faster than impacts begin comes back with e of
/// the speed that it could have; κ/h is more than any spring has. A contact that does so gives energy away only where
/// it does not close, so it may always part as fast as it has closed. What has no spring yet is *fresh*: it is rigid
/// to what parts, and pushed out of its overlap.
/// @param before κ of the step before, 0 where there is no spring
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> resting_law(
    const ContactEvent<N>& event, const N& before, const N& compliance, const N& per_way, const LawOfStep& step)
{
    const N none = {}, infinite = none + __builtin_inf();
    const Compression<N> now(springy_overlap<N>(event), before, step);
    const Answer<N> is_spring = before > 0.0, keeps = is_spring | begins_spring<N>(event, step);
    const N feedback = per_way * now.kappa;
    const N parting =
        larger<N>(slow_parting<N>(step) + event.restitution * now.kappa * (1.0 / step.h), -event.u_n_before);
    return {is_spring ? feedback : passive_target<N>(feedback, event.u_n_before), compliance,
        is_spring ? parting : infinite, keeps ? now.kappa : -infinite, now.grown, keeps ? none : feedback};
}

/// It overlaps so much that it yields: it bears as a spring that all of its overlap has pressed, and forgets. The
/// deeper it is, the less of its spring is left. It parts with p times its overlap over R*, at most with p, and no
/// faster than impacts begin: slowly, since a column of such contacts parts with the sum of their speeds.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> yielding_law(
    const ContactEvent<N>& event, const N& before, const N& compliance, const N& per_way, const LawOfStep& step)
{
    const N most = elastic_overlap<N>(event, step), strain = -event.gap / most;
    const N strength = per_way * (-event.gap - event.full_shift);
    const Compression<N> now(smaller<N>(most / strain, springy_overlap<N>(event)), before, step);
    const Answer<N> keeps = (before > 0.0) | begins_spring<N>(event, step);
    const N most_pushing = N{} + smaller(step.push_out_speed, step.elastic_speed);
    const N by_depth = step.push_out_speed * -event.gap / event.reduced_radius;
    const N push = smaller<N>(smaller<N>(most_pushing, by_depth), strength);
    const N alone = passive_target<N>(push, event.u_n_before);
    return {larger<N>(alone, strength), compliance / stiffening<N>(event), alone,
        keeps ? borne_compression<N>(now.kappa, event.u_n_before, step) : N{} - __builtin_inf(), now.grown, push};
}

/// `projected`: it is rigid where it touches, but the softer the more it overlaps. It bears as a spring that all of its
/// overlap has pressed, so that no load sinks, and parts no faster than it would alone: with what sweeps leave undone
/// of its load. Its Σ_n is so small where it is shallow that nobody sees it, but where walls leave too little room,
/// impulses that no velocity obeys do not grow with every sweep. What W + Σ rounds away is 0.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> rigid_law(const ContactEvent<N>& event, const LawOfStep& step)
{
    const N none = {}, w = event.inverse_mass_sum, strength = -event.gap * (4.0 * upsilon / step.h);
    const N part = smaller<N>(none + 1.0, -event.gap / (rigid_yield_overlap * event.diameter)), square = part * part;
    const N compliance = w + rigid_softness * square * square * w - w;
    const N push =
        smaller<N>(larger<N>(none, smaller<N>(none + step.push_out_speed, strength)), undone_share * w * event.load);
    const N alone = smaller<N>(none, 2.0 * push - event.u_n_before);
    return {larger<N>(alone, strength), compliance / stiffening<N>(event), alone, none - __builtin_inf(), none, push};
}

/// The first where this is so, else the second.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> chosen(
    const Answer<N>& answer, const NormalLaw<N>& yes, const NormalLaw<N>& no)
{
    return {answer ? yes.target : no.target, answer ? yes.compliance : no.compliance, answer ? yes.parting : no.parting,
        answer ? yes.compression : no.compression, answer ? yes.grown : no.grown, answer ? yes.push : no.push};
}

/// The law of a contact where no impact is beside it.
template <class N>
[[gnu::always_inline]] inline NormalLaw<N> normal_law(
    const ContactEvent<N>& event, const Answer<N>& impact, const LawOfStep& step)
{
    const Answer<N> open = !touches<N>(event.gap, step), yields = overstrained<N>(event, step);
    const N w = event.inverse_mass_sum, compliance = spring_compliance<N>(event.stiffness, w, step);
    const N share = feedback_share<N>(compliance, w, step);
    const N per_way = 4.0 * upsilon / step.h * share; // of feedback: the speed that it asks for, by κ
    const N least = N{} + touching_gap * step.min_diameter;
    const N before = event.compression > least ? event.compression : N{};

    NormalLaw<N> law =
        step.rigid ? rigid_law<N>(event, step) : resting_law<N>(event, before, compliance, per_way, step);
    if (!step.rigid && any_of(yields))
        law = chosen<N>(yields, yielding_law<N>(event, before, compliance, per_way, step), law);
    law = chosen<N>(open, open_law<N>(event, step.rigid ? N{} : compliance, step), law);
    return any_of(impact) ? chosen<N>(impact, impact_law<N>(event), law) : law;
}

} // namespace talus
