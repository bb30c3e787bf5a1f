// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/wall_assembly.hpp"

#include "core/contacts/attractions.hpp"
#include "core/contacts/rolling_rows.hpp"
#include "core/packs/kernels.hpp"

#include <bit>

namespace talus
{

WallAssembly::WallAssembly(TileContacts& contacts, bool with_pistons, const CarriedImpulses& carried,
    StepContacts& scratch, const State& state, const Model& model, const StepConstants& step)
    : contacts_(contacts), with_pistons_(with_pistons), carried_(carried), impacts_(scratch.impacts),
      room_(scratch.room()), state_(state), model_(model), step_(step)
{
    room_.filler.begin(contacts, state.count());
}

void WallAssembly::add(const WallTouch& at)
{
    const std::size_t k = with_pistons_ ? contacts_.append() : room_.filler.place(at.sphere, -1);
    const std::size_t p = k / pack_size, lane = k % pack_size;
    const CarriedContact& carried = carried_.contact[at.slot];
    contacts_.place(k, at.sphere, at.wall, at.slot);
    contacts_.set_touch(k, carried.touch);
    contacts_.set_wall_level(k, at.wall_level);
    if (contacts_.has_moving_walls()) contacts_.set_wall(k, at.row);

    const ContactLaw& law = model_.materials.between(state_.material[at.sphere], model_.walls[at.wall].material);
    ContactPack& contact = contacts_.pack(p);
    contact.friction[lane] = law.friction;
    contact.arm_scale[lane] = 1.0;
    if (room_.touches.size() <= p) room_.touches.resize(p + 1);
    TouchPack& touch = room_.touches[p];
    for (int d = 0; d < 3; ++d) {
        contact.normal[d][lane] = at.normal[d];
        touch.carried[d][lane] = carried.impulse[d];
    }
    touch.inverse_mass_sum[lane] = at.inverse_mass_sum;
    touch.restitution[lane] = law.restitution;
    touch.stiffness[lane] = law.stiffness;
    touch.modulus[lane] = step_.law.elastic ? law.modulus : 0.0;
    touch.compression[lane] = carried.compression;
    touch.struck[lane] = -static_cast<std::int64_t>(carried.touch.last() == TouchRecord::impact);
    touch.pushed[lane] = -static_cast<std::int64_t>(carried.touch.last() == TouchRecord::closing_a_gap);
    touch.gap[lane] = at.gap;
    touch.diameter[lane] = 2.0 * state_.radius[at.sphere];
    touch.reduced_radius[lane] = state_.radius[at.sphere];
    touch.u_n[lane] = at.u_n;
    touch.u_n_before[lane] = at.u_n_before;
    touch.closes[lane] = at.closes;
}

ContactSurvey WallAssembly::make()
{
    TouchSums sums;
    double attraction_energy = 0.0;
    for (std::size_t p = 0; p < contacts_.packs(); ++p) {
        const ContactPack& pack = contacts_.pack(p);
        PackImpacts impacts =
            fastest_kernels().touch.touch_walls(contacts_.pack(p), contacts_.record(p), room_.touches[p], sums, step_);
        if (contacts_.has_rolling()) make_rolling_rows(contacts_, p, true, carried_.rolling_impulse, state_, model_);
        if (contacts_.has_attraction())
            attraction_energy += find_attractions(contacts_, p, true, carried_, state_, model_, step_.law.h);
        for (; impacts.lanes != 0; impacts.lanes &= impacts.lanes - 1) {
            const int lane = std::countr_zero(impacts.lanes);
            impacts_[pack.a[lane]].note(impacts.size[lane], 0.0); // nothing is heavier than what stands still
        }
    }
    return survey_of(sums, attraction_energy);
}

} // namespace talus
