// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/contact_law.hpp"

#include <algorithm>
#include <optional>

/// Impacts, and what stands beside them, METHOD (4): impacts are handed on from sphere to sphere, a step for each.
namespace talus
{

/// When two spheres that move so touch: infinite if never, negative if they overlap and approach [s].
/// @param approach −Δx·Δv; @param speed_squared of Δv; @param apart |Δx|² − (r_a + r_b)²
template <class N>
[[gnu::always_inline]] inline N closing_time(const N& approach, const N& speed_squared, const N& apart)
{
    const N square = approach * approach - speed_squared * apart;
    const N closes = apart / (approach + root<N>(larger<N>(N{}, square)));
    return ((approach > 0.0) & (square >= 0.0)) ? closes : N{} + __builtin_inf();
}

/// The impulse that an impact by itself would have [N s].
template <class N> [[gnu::always_inline]] inline N impact_size(const ContactEvent<N>& event)
{
    return (1.0 + event.restitution) * larger<N>(N{}, -event.u_n) / event.inverse_mass_sum;
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

/// A contact, itself no impact, of which a sphere has one.
struct Bystander {
    double gap;         ///< g [m]
    double u_n;         ///< of v⁽⁰⁾, against the velocity that the wall had in the step before [m/s]
    double compression; ///< κ [m]
    double impulse;     ///< λ_n carried over [N s]
    bool was_impact;    ///< in the step before
    double impact;      ///< impulse of the largest impact of its two spheres, had it that alone [N s]
    double pressed;     ///< largest impulse with which other spheres press on its two, carried over [N s]

    double load(const LawOfStep& step) const { return step.parts * impulse; }
    /// Whether it bears a load, and the impact with it.
    bool is_loaded(const LawOfStep& step) const { return load(step) >= load_share * impact; }
};

/// What such a contact does.
struct BesideImpact {
    ContactKind kind;
    double target;      ///< q_n [m/s]; Σ_n = 0
    double compression; ///< κ that it keeps [m]; −∞: none
    double hands_on;    ///< normal impulse at most [N s]
};

/// One that had no load is *deferred*: it does not close further than to `deferred_overlap`, and in the next step it is
/// an impact of its own. One with a load that is light beside the impact *bears* it: it is rigid. So is what was an
/// impact and parts. All others stay what they are. What impacts press on beside them is no load that a contact may
/// count on in the next step, but what its spheres bore is.
inline std::optional<BesideImpact> beside_impact(const Bystander& at, const LawOfStep& step)
{
    const bool is_loaded = at.is_loaded(step), is_light = at.load(step) < light_share * at.impact;
    const bool parts = at.was_impact && at.u_n > touching_gap * step.min_diameter / step.h; // but for rounding
    if (parts || (is_loaded && is_light))
        return {{ContactKind::bearing, std::min(-std::max(0.0, at.gap) / step.h, -at.u_n),
            borne_compression<double>(at.compression, at.u_n, step), std::max(at.impulse, at.pressed)}};
    if (!is_loaded && !at.was_impact)
        return {{ContactKind::deferred, std::min(-(at.gap + deferred_overlap * step.min_diameter) / step.h, -at.u_n),
            -__builtin_inf(), 0.0}};
    return {};
}

/// Of a mass that strikes a sphere to the sphere's; beyond `most_impact_ratio` that of what is heavier on both sides of
/// it, of what strikes and of what bears it.
inline double impact_ratio(double mass, double inverse_mass, double inverse_mass_of_other)
{
    if (mass * inverse_mass <= most_impact_ratio) return mass * inverse_mass;
    return inverse_mass / (1.0 / mass + inverse_mass_of_other);
}

} // namespace talus
