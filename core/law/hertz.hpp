// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/contact_law.hpp"

#include <cmath>

/// The spring of materials whose modulus is known (Hertz 1882): pressed by κ it pushes with 4/3 E* √R* κ^(3/2), and
/// stores 8/15 E* √R* κ^(5/2), up to where it is as stiff as sweeps can carry, and straight on from there.
///
/// A step has a spring of one stiffness, METHOD (1). That which holds what Hertz's holds, and pushes as hard, is 5/4 of
/// his secant k stiff and pressed by 4/5 of κ: so a step begins with what the one before has handed on, to the last
/// joule, and κ follows from that.
namespace talus
{

/// Hertz's secant stiffness, force over κ, under this force [N/m]. @param modulus E* [Pa]
inline double secant_stiffness(double modulus, double reduced_radius, double force)
{
    const double by_kappa = 4.0 / 3.0 * modulus * std::sqrt(reduced_radius); // force = that κ^(3/2)
    return std::cbrt(by_kappa * by_kappa * force);
}

/// K: the stiffness of a spring as stiff as sweeps can carry, whole steps' or sub-steps' [N/m].
template <class N> [[gnu::always_inline]] inline N carried_stiffness(const N& inverse_mass_sum, const LawOfStep& step)
{
    const double whole = step.parts * step.h;
    return 4.0 * upsilon / (carried_compliance<N>(inverse_mass_sum, step) * whole * whole);
}

/// x^(2/5) for 0 ≤ x ≤ 1, by Newton's method for the fifth root.
template <class N> [[gnu::always_inline]] inline N two_fifths_power(const N& x)
{
    constexpr int iterations = 7; // from x^(3/16): to 1e-10 from x = 1e-24 on
    N y = root<N>(root<N>(root<N>(x * root<N>(x))));
    for (int k = 0; k < iterations; ++k) {
        const N square = y * y, fourth = square * square;
        y = fourth > 0.0 ? 0.8 * y + 0.2 * x / fourth : N{};
    }
    return y * y;
}

/// Where Hertz's law meets K, and what it says of one contact on both sides of that.
template <class N> struct HertzLaw {
    N knee; ///< κ at which the spring of a step is K stiff [m]; 0: the material is rigid

    /// @param modulus E* [Pa]; @param carried K [N/m]
    [[gnu::always_inline]] HertzLaw(const N& modulus, const N& reduced_radius, const N& carried)
    {
        const N whole = 0.6 * carried / modulus; // 5/4 · 4/3 E* √(R* κ) = K
        knee = whole * whole / reduced_radius;
    }

    /// How stiff the spring of a step is, in K. @param kappa [m], above 0
    [[gnu::always_inline]] N softness(const N& kappa) const { return smaller<N>(N{} + 1.0, root<N>(kappa / knee)); }

    /// The κ that a force presses, by the length to which it presses a spring of stiffness K [m].
    double compression_under(double length) const
    {
        const double at_knee = 0.8 * knee;
        return length < at_knee ? knee * std::cbrt(std::pow(length / at_knee, 2)) : length + 0.2 * knee;
    }

    /// What κ stores, as the square of the length at which a spring of stiffness K stores it [m²].
    [[gnu::always_inline]] N stored(const N& kappa) const
    {
        const N beyond = kappa - 0.2 * knee;
        return kappa < knee ? 0.64 * kappa * kappa * root<N>(kappa / knee) : beyond * beyond;
    }

    /// The κ that stores so much [m].
    [[gnu::always_inline]] N compression(const N& stored) const
    {
        const N at_knee = 0.64 * knee * knee;
        const N beyond = root<N>(stored) + 0.2 * knee;
        if (!any_of(stored < at_knee)) return beyond;
        return stored < at_knee ? knee * two_fifths_power<N>(stored / at_knee) : beyond;
    }
};

/// What a spring stores at a length, over what one of stiffness K would store there.
template <class N>
[[gnu::always_inline]] inline N share_of_carried(const N& compliance, const N& inverse_mass_sum, const LawOfStep& step)
{
    const N most = carried_compliance<N>(inverse_mass_sum, step);
    return feedback_share<N>(compliance, inverse_mass_sum, step) * most /
           (compliance * feedback_share<N>(most, inverse_mass_sum, step));
}

/// The spring with which a contact begins a step.
template <class N> struct StepSpring {
    N stiffness;   ///< k [N/m]
    N compression; ///< κ of that [m]; 0: there is none
    N shift;       ///< by how much more Hertz's is pressed: the overlap at which the force would begin [m]
    N full_shift;  ///< the same, were it pressed by all of the overlap [m]
};

/// The spring of a step, of what the step before has handed on. It is as stiff as Hertz's where that is pressed most:
/// by κ, by all of the overlap, or by what closes in the step. Nowhere does it hold more than was handed on.
/// @param handed the length at which K stores that [m]; @param loaded in the step before
template <class N>
[[gnu::always_inline]] inline StepSpring<N> spring_of_step(
    const N& handed, const Answer<N>& loaded, const ContactEvent<N>& event, const N& modulus, const LawOfStep& step)
{
    const N w = event.inverse_mass_sum, u_n = event.u_n_before, none = {};
    const N carried = carried_stiffness<N>(w, step);
    const HertzLaw<N> law(modulus, event.reduced_radius, carried);
    const N kappa = law.compression(handed * handed);
    const N pressed =
        larger<N>(larger<N>(kappa, -event.gap), larger<N>(none + touching_gap * step.min_diameter, -step.h * u_n));
    const N stiffness = smaller<N>(event.stiffness, carried * law.softness(pressed));

    const N compliance = spring_compliance<N>(stiffness, w, step), share = share_of_carried<N>(compliance, w, step);
    const N length = handed / root<N>(share), way = 0.5 * step.h * u_n;
    const Answer<N> elastic = law.knee > 0.0;
    const N taken = taken_over<N>(
        length, loaded, elastic ? event.gap + kappa - length : event.gap, u_n, event.restitution, compliance, w, step);
    const N held = larger<N>(none, taken + way), overlap = larger<N>(none, way - event.gap);
    const N middle = smaller<N>(law.compression(share * held * held), overlap),
            borne = root<N>(law.stored(middle) / share);
    const N compression = elastic ? borne - way : taken;
    const Answer<N> is_spring = (taken > 0.0) & (compression > touching_gap * step.min_diameter);
    const N all = root<N>(law.stored(larger<N>(none, -event.gap)) / share);
    return {stiffness, is_spring ? compression : none, (elastic & is_spring) ? middle - borne : none,
        elastic ? -event.gap - all : none};
}

} // namespace talus
