// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/pack_filler.hpp"
#include "core/packs/kernels.hpp"
#include "core/world/state.hpp"

#include <algorithm>
#include <atomic>

namespace talus
{

/// A touch of a sphere and a wall, as detection found it: fields as in TouchPack.
struct WallTouch {
    std::int32_t sphere, wall;
    Vec3 normal;
    double gap, u_n, u_n_ahead, closes, u_n_before, u_n_turned;
    double inverse_mass_sum; ///< W
    std::uint32_t slot;
    double wall_level; ///< of ContactGeometry
    WallRow row = {};  ///< at walls that move
};

/// What a tile's spheres touch.
enum class Touched { spheres, walls, pistons };

/// Makes the contacts of a tile, eight at a time: with each other, or with walls. Those with pistons, of all tiles, are
/// made one by one.
class TileAssembly
{
public:
    TileAssembly(TileContacts& contacts, Touched touched, CarriedImpulses& carried, StepContacts& scratch,
        const State& state, const Model& model, const StepConstants& step)
        : contacts_(contacts), with_walls_(touched != Touched::spheres), one_by_one_(touched == Touched::pistons),
          carried_(carried), scratch_(scratch), filler_(scratch.room().filler), touch_(scratch.room().touch),
          state_(state), model_(model), step_(step)
    {
        filler_.begin(contacts, state.count());
    }

    /// Two spheres that may touch.
    void add(std::int32_t a, std::int32_t b, std::uint32_t slot)
    {
        prepare(touch_.count++, a, b, slot, model_.materials.between(state_.material[a], state_.material[b]));
        if (touch_.count == pack_size) make();
    }

    /// Returns whether it has become a contact, where that is known at once.
    bool add(const WallTouch& at, const ContactLaw& law)
    {
        const int lane = touch_.count++;
        prepare(lane, at.sphere, at.wall, at.slot, law);
        for (int d = 0; d < 3; ++d) touch_.contact.normal[d][lane] = at.normal[d];
        touch_.contact.arm_scale[lane] = 1.0;
        touch_.contact.inverse_mass_sum[lane] = at.inverse_mass_sum;
        touch_.gap[lane] = at.gap;
        touch_.u_n[lane] = at.u_n;
        touch_.u_n_ahead[lane] = at.u_n_ahead;
        touch_.closes[lane] = at.closes;
        touch_.u_n_before[lane] = at.u_n_before;
        touch_.u_n_turned[lane] = at.u_n_turned;
        wall_level_[lane] = at.wall_level;
        wall_row_[lane] = at.row;
        const std::size_t before = survey_.count;
        if (touch_.count == pack_size || one_by_one_) make();
        return survey_.count > before;
    }

    ContactSurvey finish()
    {
        make();
        filler_.end();
        return survey_;
    }

private:
    TileContacts& contacts_;
    const bool with_walls_, one_by_one_;
    CarriedImpulses& carried_;
    StepContacts& scratch_;
    PackFiller& filler_;
    TouchPack& touch_;
    const State& state_;
    const Model& model_;
    const StepConstants& step_;
    const TouchKernel& kernel_ = fastest_kernels().touch;
    ContactSurvey survey_;
    std::uint32_t slot_[pack_size];
    double wall_level_[pack_size];
    WallRow wall_row_[pack_size];

    /// What does not depend on where and how fast they are.
    void prepare(int lane, std::int32_t a, std::int32_t b, std::uint32_t slot, const ContactLaw& law)
    {
        touch_.contact.a[lane] = a;
        touch_.contact.b[lane] = b;
        touch_.contact.friction[lane] = law.friction;
        touch_.restitution[lane] = law.restitution;
        touch_.stiffness[lane] = law.stiffness;
        for (int d = 0; d < 3; ++d) touch_.carried[d][lane] = carried_.impulse[slot][d];
        touch_.free_overlap[lane] = carried_.free_overlap[slot];
        touch_.loaded[lane] = -static_cast<std::int64_t>(carried_.touch[slot].is_loaded());
        touch_.jammed[lane] = -static_cast<std::int64_t>(carried_.touch[slot].is_jammed());
        slot_[lane] = slot;
    }

    void make()
    {
        if (touch_.count == 0) return;
        ContactPack& contact = touch_.contact;
        for (int lane = touch_.count; lane < pack_size; ++lane) { // of some spheres that are there
            contact.a[lane] = contact.a[0];
            contact.b[lane] = contact.b[0];
        }
        if (with_walls_)
            kernel_.make_contacts(touch_, step_);
        else
            kernel_.touch_spheres(
                touch_, scratch_.reach_balls.data(), reinterpret_cast<const double*>(state_.motion.data()), step_);
        for (int lane = 0; lane < touch_.count; ++lane) take(lane);
        touch_.count = 0;
    }

    /// Into the problem, unless it is left out.
    void take(int lane)
    {
        const std::uint32_t slot = slot_[lane];
        if (!with_walls_ && !touch_.within_reach[lane]) return carried_.clear(slot);
        const double gap = touch_.gap[lane];
        note_overlap(gap);
        carried_.free_overlap[slot] = static_cast<float>(touch_.free_overlap[lane]);
        const bool waits = touch_.waits[lane];
        if (touch_.passes_by[lane] || (waits && one_by_one_)) return;

        const std::int32_t a = touch_.contact.a[lane], b = touch_.contact.b[lane];
        const std::size_t k = one_by_one_ ? contacts_.append() : filler_.place(a, with_walls_ ? -1 : b);
        const auto kind = touch_.impact[lane] ? ContactKind::impact
                          : touch_.open[lane] ? ContactKind::open
                                              : ContactKind::resting;
        contacts_.copy(k, touch_.contact, lane, {gap, wall_level_[lane], slot, kind, waits});
        if (contacts_.has_moving_walls()) contacts_.set_wall(k, wall_row_[lane]);
        if (contacts_.has_rolling()) contacts_.set_rolling(k, rolling_row(k, slot, kind));
        if (kind == ContactKind::impact) mark(scratch_.struck, a, b);
        if (touch_.carries[lane] && !with_walls_) mark(scratch_.loaded, a, b);
        ++survey_.count;
        survey_.impacts += kind == ContactKind::impact;
        survey_.stored_energy += touch_.stored_energy[lane];
    }

    /// Tiles that share a sphere may do so at once.
    void mark(std::vector<std::uint8_t>& spheres, std::int32_t a, std::int32_t b) const
    {
        std::atomic_ref(spheres[a]).store(1, std::memory_order_relaxed);
        if (!with_walls_) std::atomic_ref(spheres[b]).store(1, std::memory_order_relaxed);
    }

    RollingRow rolling_row(std::size_t k, std::uint32_t slot, ContactKind kind) const
    {
        const Motion& a = state_.motion[contacts_.a(k)];
        double radius = a.radius, inertia = inverse_inertia(a);
        const ContactLaw* law = nullptr;
        if (with_walls_)
            law = &model_.materials.between(state_.material[contacts_.a(k)], model_.walls[contacts_.b(k)].material);
        else {
            const Motion& b = state_.motion[contacts_.b(k)];
            radius = a.radius * b.radius / (a.radius + b.radius);
            inertia += inverse_inertia(b);
            law = &model_.materials.between(state_.material[contacts_.a(k)], state_.material[contacts_.b(k)]);
        }
        RollingRow row{Vec3::Zero(), law->rolling_friction * radius, 1.0 / inertia};
        if (kind == ContactKind::impact) return row;
        const Vec3 normal = contacts_.normal(k);
        const Vec3& carried = carried_.rolling_impulse[slot];
        row.impulse = carried - carried.dot(normal) * normal;
        const double largest = row.reach * contacts_.impulse(k).dot(normal);
        const double size = row.impulse.norm();
        if (size > largest) row.impulse *= largest / size;
        return row;
    }

    static double inverse_inertia(const Motion& m)
    {
        return inverse_inertia_factor * m.inverse_mass / (m.radius * m.radius);
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
