// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/contact_survey.hpp"
#include "core/contacts/rolling_row.hpp"
#include "core/packs/kernels.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <algorithm>

namespace talus
{

/// A touch of a sphere and a wall, as detection found it: fields as in TouchPack.
struct WallTouch {
    std::int32_t sphere, wall;
    Vec3 normal;
    double gap, u_n, u_n_before, closes;
    double inverse_mass_sum; ///< W
    std::uint32_t slot;
    double wall_level; ///< of ContactGeometry
    WallRow row = {};  ///< at walls that move
};

/// Makes the contacts of a tile with walls, eight at a time. Those with pistons, of all tiles, are made one by one.
class WallAssembly
{
public:
    WallAssembly(TileContacts& contacts, bool with_pistons, CarriedImpulses& carried, StepContacts& scratch,
        const State& state, const Model& model, const StepConstants& step)
        : contacts_(contacts), one_by_one_(with_pistons), carried_(carried), impacts_(scratch.impacts),
          filler_(scratch.room().filler), contact_(scratch.room().contact), touch_(scratch.room().touch), state_(state),
          model_(model), step_(step)
    {
        filler_.begin(contacts, state.count());
    }

    /// Returns whether it has become a contact, where that is known at once.
    bool add(const WallTouch& at, const ContactLaw& law)
    {
        const int lane = count_++;
        contact_.a[lane] = at.sphere;
        contact_.b[lane] = at.wall;
        contact_.friction[lane] = law.friction;
        for (int d = 0; d < 3; ++d) contact_.normal[d][lane] = at.normal[d];
        contact_.arm_scale[lane] = 1.0;
        touch_.inverse_mass_sum[lane] = at.inverse_mass_sum;
        touch_.restitution[lane] = law.restitution;
        touch_.stiffness[lane] = law.stiffness;
        const CarriedContact& carried = carried_.contact[at.slot];
        for (int d = 0; d < 3; ++d) touch_.carried[d][lane] = carried.impulse[d];
        touch_.compression[lane] = carried.compression;
        touch_.struck[lane] = -static_cast<std::int64_t>(carried.touch.was_impact());
        touch_.pushed[lane] = -static_cast<std::int64_t>(carried.touch.was_open());
        touch_.gap[lane] = at.gap;
        touch_.diameter[lane] = 2.0 * state_.radius(at.sphere);
        touch_.reduced_radius[lane] = state_.radius(at.sphere);
        touch_.u_n[lane] = at.u_n;
        touch_.u_n_before[lane] = at.u_n_before;
        touch_.closes[lane] = at.closes;
        slot_[lane] = at.slot;
        wall_level_[lane] = at.wall_level;
        row_[lane] = at.row;
        const std::size_t before = survey_.count;
        if (count_ == pack_size || one_by_one_) make();
        return survey_.count > before;
    }

    ContactSurvey finish()
    {
        make();
        return survey_;
    }

private:
    TileContacts& contacts_;
    const bool one_by_one_;
    CarriedImpulses& carried_;
    std::vector<SphereImpacts>& impacts_;
    PackFiller& filler_;
    ContactPack& contact_; ///< of the next eight …
    TouchPack& touch_;     ///< … with what was found of them
    const State& state_;
    const Model& model_;
    const StepConstants& step_;
    ContactSurvey survey_;
    int count_ = 0; ///< of the next eight
    std::uint32_t slot_[pack_size];
    double wall_level_[pack_size];
    WallRow row_[pack_size];

    void make()
    {
        if (count_ == 0) return;
        fastest_kernels().touch.make_contacts(contact_, touch_, step_); // lanes that are left over hold anything
        for (int lane = 0; lane < count_; ++lane) take(lane);
        count_ = 0;
    }

    void take(int lane)
    {
        const std::uint32_t slot = slot_[lane];
        const double gap = touch_.gap[lane];
        note_overlap(gap);
        const std::int32_t sphere = contact_.a[lane];
        const std::size_t k = one_by_one_ ? contacts_.append() : filler_.place(sphere, -1);
        const auto kind = static_cast<ContactKind>(touch_.kind[lane]);
        const bool is_impact = kind == ContactKind::impact;
        contacts_.copy(k, contact_, touch_, static_cast<std::size_t>(lane),
            {.gap = gap,
                .wall_level = wall_level_[lane],
                .slot = slot,
                .kind = kind,
                .touch = carried_.contact[slot].touch,
                .compression = static_cast<float>(touch_.compression[lane]),
                .held = static_cast<float>(touch_.held[lane]),
                .spring = static_cast<float>(touch_.spring[lane]),
                .restitution = static_cast<float>(touch_.restitution[lane]),
                .hands_on = is_impact ? 0.0F : INFINITY,
                .push = static_cast<float>(touch_.push[lane])});
        if (contacts_.has_moving_walls()) contacts_.set_wall(k, row_[lane]);
        if (contacts_.has_rolling()) {
            const Motion& m = state_.motion[sphere];
            const auto& law =
                model_.materials.between(state_.material[sphere], model_.walls[contact_.b[lane]].material);
            contacts_.set_rolling(
                k, rolling_row(contacts_, k, law, m.radius, inverse_inertia(m), carried_.rolling_impulse[slot]));
        }
        if (is_impact)
            impacts_[sphere].note(touch_.impact_size[lane], 0.0); // nothing is heavier than what stands still
        ++survey_.count;
        survey_.impacts += is_impact;
        survey_.worst_strain = std::max(survey_.worst_strain, touch_.strain[lane]);
        survey_.stored_energy += touch_.stored_energy[lane];
        survey_.push_out_energy += touch_.push_out_energy[lane];
    }

    void note_overlap(double gap)
    {
        if (gap >= 0.0) return;
        ++survey_.overlapping;
        survey_.worst_overlap = std::max(survey_.worst_overlap, -gap);
        survey_.overlap_sum -= gap;
    }
};

} // namespace talus
