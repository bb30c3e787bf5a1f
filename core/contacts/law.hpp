// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact.hpp"
#include "core/world/model.hpp"

#include <algorithm>
#include <cmath>

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

/// The normal law u_n + Σ_n λ_n ≥ q_n of one contact.
struct NormalLaw {
    double target;               ///< q_n [m/s]
    double compliance;           ///< Σ_n [1/kg]
    double feedback_share = 1.0; ///< of the feedback on overlap, and so of the stiffness 4Υ/(Σ_n h²), that it takes
};

/// What the law of a contact depends on.
struct ContactEvent {
    ContactKind kind;
    double gap;              ///< g, of a resting contact that of its spring, g + f [m]
    double u_n;              ///< of v⁽⁰⁾, before gravity [m/s]
    double inverse_mass_sum; ///< W [1/kg]
    double carried_normal;   ///< λ_n⁽⁰⁾ [N s]
    bool jammed = false;     ///< TouchRecord
    double u_n_turned = 0.0; ///< what the turn of a wall's normal since the step before has added to u_n [m/s]
};

/// Σ_n of a resting contact of `matched`: that of the material's stiffness k, but no stiffer than N_min sweeps can
/// carry.
inline double matched_compliance(const ContactLaw& law, double inverse_mass_sum, double h, int min_sweeps)
{
    return std::max(4.0 * upsilon / (law.stiffness * h * h), sigma_per_sweep / min_sweeps * inverse_mass_sum);
}

/// The part of an overlap that is no spring yet: an impact has left it, or has closed the gap of another contact, and
/// no load has pressed it. If it pushed at once, it would give back what nobody has stored. A share of it becomes a
/// spring in each step.
/// @param before what it was in the step before, if it was loaded there [m]; else infinite
inline double free_overlap(double gap, double before)
{
    constexpr double kept =
        0.7; // a pile that is poured gains a tenth of what it gains with 0; with 0.9 beds are deeper
    return kept * std::min(before, std::max(0.0, -gap));
}

/// What a sub-step takes of the feedback on overlap. The stiffness that sweeps can carry goes with 1/h², so with all of
/// it a bed at rest would rise when its step is split. Shallow overlaps keep the stiffness of the whole step, and those
/// five times as deep have that of the sub-step.
inline double feedback_share(
    const ContactEvent& event, const ContactLaw& law, const SolverSettings& solver, const StepLength& step)
{
    const auto compliance_in = [&](double h) {
        return matched_compliance(law, event.inverse_mass_sum, h, solver.min_sweeps);
    };
    const double as_stiff = compliance_in(step.h()) / (compliance_in(step.parts * step.h()) * step.parts * step.parts);
    const double deep = std::clamp((-event.gap / step.shallow_overlap - 1.0) / 4.0, 0.0, 1.0);
    return as_stiff + deep * (1.0 - as_stiff);
}

/// `matched` (the default): the note's own step, eq. (2), with a compliance that the sweeps can carry. Of the feedback
/// on overlap, what exceeds the need of the carried impulse is capped, so that a deep overlap does not become a shot.
/// A jammed contact does not hold what it carries: it parts with the cap at most, and stores nothing.
inline NormalLaw matched_law(
    const ContactEvent& event, const ContactLaw& law, const SolverSettings& solver, const StepLength& step)
{
    const double h = step.h();
    const double compliance = matched_compliance(law, event.inverse_mass_sum, h, solver.min_sweeps);
    if (event.jammed) return {std::min(-4.0 / h * upsilon * event.gap, solver.push_out_speed), compliance, 0.0};
    const double share = step.is_split() ? feedback_share(event, law, solver, step) : 1.0;
    const double held = compliance * event.carried_normal;
    const double push_out = std::min(-4.0 / h * upsilon * share * event.gap - held, solver.push_out_speed);
    return {held + push_out + upsilon * event.u_n, compliance, share};
}

/// What a rigid contact at a concave wall gives back of the velocity that it takes. A sphere that runs along it goes on
/// chords: the turn of the normal makes it meet the wall with u_n < 0 in every step, and u_n ≥ 0 would brake it. With
/// half of the turn against each end of a chord its speed is kept. Never more than it came with.
inline double turned_back(const ContactEvent& event)
{
    return std::max(0.0, std::min(-event.u_n, -0.5 * event.u_n_turned));
}

/// `projected`: rigid, u_n ≥ 0; overlap is removed by moving the spheres (position_projection.hpp). A jammed contact
/// yields: it has an impulse in proportion to the speed with which it is closed, and none when it is not.
inline NormalLaw projected_law(
    const ContactEvent& event, const ContactLaw& law, const SolverSettings& solver, const StepLength& step)
{
    if (!event.jammed) return {turned_back(event), 0.0};
    return {0.0, matched_compliance(law, event.inverse_mass_sum, step.h(), solver.min_sweeps)};
}

/// The law of a contact by its kind: METHOD (4).
inline NormalLaw normal_law(
    const ContactEvent& event, const ContactLaw& law, const SolverSettings& solver, const StepLength& step)
{
    const bool rigid = solver.stabilisation == Stabilisation::projected;
    switch (event.kind) {
    case ContactKind::impact:
        return {-law.restitution * event.u_n, 0.0};
    case ContactKind::open:
        return {-event.gap / step.h() + (rigid ? turned_back(event) : 0.0), 0.0};
    case ContactKind::resting:
        break;
    }
    return rigid ? projected_law(event, law, solver, step) : matched_law(event, law, solver, step);
}

/// When two spheres that move so touch: infinite if never, negative if they overlap and approach [s].
/// @param across from one centre to the other; @param radii their sum
inline double closing_time(const Vec3& across, const Vec3& velocity, double radii)
{
    const double approach = -across.dot(velocity), apart = across.squaredNorm() - radii * radii;
    const double root = approach * approach - velocity.squaredNorm() * apart;
    return approach > 0.0 && root >= 0.0 ? apart / (approach + std::sqrt(root)) : infinity;
}

/// Which law a contact follows in this step.
/// @param closes when the gap does so by itself [s]; @param loaded in the step before it had an impulse
inline ContactKind contact_kind(
    double gap, double u_n, double closes, bool loaded, const ContactLaw& law, double h, double threshold_speed)
{
    const bool fast = law.restitution > 0.0 && u_n < -threshold_speed;
    const bool begins = gap <= 0.0 ? !loaded : closes < h;
    if (fast && begins) return ContactKind::impact;
    return gap <= 0.0 ? ContactKind::resting : ContactKind::open;
}

} // namespace talus
