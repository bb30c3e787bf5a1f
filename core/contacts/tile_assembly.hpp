// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/law.hpp"
#include "core/contacts/pack_filler.hpp"
#include "core/world/state.hpp"

#include <algorithm>

namespace talus
{

inline constexpr double touching = 1e-9; ///< overlap of spheres laid side by side, for rounding [smallest diameters]

/// Numbers that all contacts of a step share.
struct StepConstants {
    StepLength length;
    double h;               ///< of the length
    double reach;           ///< of open contacts [m]
    double threshold_speed; ///< slowest impact: that of the whole step [m/s]

    StepConstants(const Model& model, const StepLength& step)
        : length(step), h(step.h()), reach(open_contact_reach * model.min_diameter),
          threshold_speed(model.solver.restitution_threshold * model.gravity.norm() * step.h() * step.parts)
    {
    }
};

/// Geometry and motion of a contact, as detection found them.
struct Touch {
    std::int32_t a, b;
    Vec3 normal;
    double gap;
    double u_n;       ///< of v⁽⁰⁾ [m/s]
    double u_n_ahead; ///< of v⁽¹⁾ [m/s]
    double closes;    ///< when the gap does so, with v⁽¹⁾ [s]; used where there is restitution
    double u_n_before; ///< of v⁽⁰⁾ against the velocity that the wall had then: 0 where a sphere goes with it [m/s]
    double u_n_turned;          ///< what the turn of the normal since the step before has added to u_n [m/s]
    double arm_scale;           ///< s
    double inverse_mass_sum;    ///< W
    double rolling_radius;      ///< R*
    double inverse_inertia_sum; ///< 1/I_a + 1/I_b [1/(kg m²)]
    std::uint32_t slot;
    WallRow wall = {}; ///< at walls that move
};

/// The impulse carried into a contact: turned into the new frame and cut back to the cone, nothing for an impact.
inline Vec3 warm_impulse(const Vec3& carried, const Vec3& normal, double friction)
{
    const double along = carried.dot(normal), normal_impulse = std::max(0.0, along);
    Vec3 tangent = carried - along * normal;
    const double largest = friction * normal_impulse, size_squared = tangent.squaredNorm();
    if (size_squared > largest * largest) tangent *= largest / std::sqrt(size_squared);
    return normal_impulse * normal + tangent;
}

/// Writes contacts of one kind and tile.
class TileAssembly
{
public:
    /// @param filler finds them places in packs; null: one after the other
    TileAssembly(TileContacts& contacts, PackFiller* filler, bool with_walls, CarriedImpulses& carried,
        const State& state, const Model& model, const StepConstants& step)
        : contacts_(contacts), filler_(filler), with_walls_(with_walls), carried_(carried), model_(model), step_(step),
          inertia_factor_(model.physics.spin ? inverse_inertia_factor : 0.0)
    {
        if (filler) filler->begin(contacts, state.count());
    }

    bool add(const Touch& touch, const ContactLaw& law, double wall_level)
    {
        const TouchRecord& before = carried_.touch[touch.slot];
        const auto kind =
            contact_kind(touch.gap, touch.u_n, touch.closes, before.is_loaded(), law, step_.h, step_.threshold_speed);
        const Vec3 warm = kind == ContactKind::impact
                              ? Vec3::Zero().eval()
                              : warm_impulse(carried_.impulse[touch.slot], touch.normal, law.friction);
        const double w = touch.inverse_mass_sum;
        const double u_n = kind == ContactKind::impact ? touch.u_n : touch.u_n_before;
        const double gap = touch.gap + free_overlap(touch, kind, law);
        const auto normal =
            normal_law({kind, gap, u_n, w, warm.dot(touch.normal), before.is_jammed(), touch.u_n_turned}, law,
                model_.solver, step_.length);
        note_overlap(touch.gap);
        const bool bears = law.restitution == 0.0 || before.is_loaded();
        const bool is_free = kind != ContactKind::impact && !bears && !step_.length.is_split();
        const bool waits = is_free && stays_apart(touch);
        if (is_free && (passes_by(touch) || (waits && !filler_))) return false;

        const std::size_t k = filler_ ? filler_->place(touch.a, with_walls_ ? -1 : touch.b) : contacts_.append();
        contacts_.set(k, {touch.a, touch.b, touch.normal, normal.target, warm},
            {touch.arm_scale, law.friction, normal.compliance, 1.0 / (w + normal.compliance),
                1.0 / (w * (1.0 + inertia_factor_ * touch.arm_scale * touch.arm_scale)), w},
            {touch.gap, wall_level, touch.slot, kind, waits});
        if (contacts_.has_moving_walls()) contacts_.set_wall(k, touch.wall);
        if (contacts_.has_rolling()) contacts_.set_rolling(k, rolling_row(touch, law, kind, warm.dot(touch.normal)));
        ++survey_.count;
        survey_.impacts += kind == ContactKind::impact;
        if (bears) survey_.stored_energy += stored_energy(gap, normal); // what an impact overlaps is no spring
        return true;
    }

    ContactSurvey finish()
    {
        if (filler_) filler_->end();
        return survey_;
    }

private:
    /// Whether it does not close by itself, or opens. What an impact elsewhere closes within this step is an impact of
    /// its own in the next one: such a contact waits beside one. Spheres that touch without a load count as apart. In a
    /// split step nothing waits: walls must hold what is thrown at them.
    bool stays_apart(const Touch& touch) const
    {
        if (touch.gap > 0.0) return touch.closes >= step_.h;
        return touch.gap + step_.h * touch.u_n_ahead >= -touching * model_.min_diameter;
    }

    /// Spheres that miss each other: the law of their gap along the normal of now would brake them.
    bool passes_by(const Touch& touch) const
    {
        return touch.gap > 0.0 && touch.closes >= step_.h && touch.gap + step_.h * touch.u_n_ahead < 0.0;
    }

    /// f, kept for the next step. Without restitution there are no impacts that would leave any.
    double free_overlap(const Touch& touch, ContactKind kind, const ContactLaw& law)
    {
        if (law.restitution == 0.0) return 0.0;
        const double before = carried_.touch[touch.slot].is_loaded() ? carried_.free_overlap[touch.slot] : infinity;
        const double now = kind == ContactKind::resting ? talus::free_overlap(touch.gap, before) : 0.0;
        carried_.free_overlap[touch.slot] = static_cast<float>(now);
        return now;
    }

    RollingRow rolling_row(const Touch& touch, const ContactLaw& law, ContactKind kind, double warm_normal) const
    {
        RollingRow row{Vec3::Zero(), law.rolling_friction * touch.rolling_radius, 1.0 / touch.inverse_inertia_sum};
        if (kind == ContactKind::impact) return row;
        const Vec3& carried = carried_.rolling_impulse[touch.slot];
        row.impulse = carried - carried.dot(touch.normal) * touch.normal;
        const double largest = row.reach * warm_normal;
        const double size = row.impulse.norm();
        if (size > largest) row.impulse *= largest / size;
        return row;
    }

    void note_overlap(double gap)
    {
        if (gap >= 0.0) return;
        ++survey_.overlapping;
        survey_.worst_overlap = std::max(survey_.worst_overlap, -gap);
        survey_.overlap_sum -= gap;
    }

    /// With k = 4 Υ / (Σ_n h²), the stiffness that the compliance stands for [J].
    double stored_energy(double gap, const NormalLaw& law) const
    {
        if (gap >= 0.0 || law.compliance == 0.0 || model_.solver.stabilisation != Stabilisation::matched) return 0.0;
        return 2.0 * upsilon / (law.compliance * step_.h * step_.h) * gap * gap * law.feedback_share;
    }

    TileContacts& contacts_;
    PackFiller* filler_;
    bool with_walls_;
    CarriedImpulses& carried_;
    const Model& model_;
    const StepConstants& step_;
    double inertia_factor_; ///< 0 where spheres do not turn
    ContactSurvey survey_;
};

} // namespace talus
