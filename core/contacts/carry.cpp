// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/carry.hpp"

#include "core/contacts/assembly.hpp"
#include "core/packs/kernels.hpp"

#include <algorithm>
#include <bit>

namespace talus
{
namespace
{

/// What contacts hand on. @param velocity_of_b what this says of contact k, after the step [m/s]
template <class VelocityOfB>
ContactOutcome carry(TileContacts& contacts, CarriedImpulses& carried, const State& state, const LawOfStep& law,
    const VelocityOfB& velocity_of_b)
{
    ContactOutcome outcome;
    HandedOn handed;
    auto* const records = reinterpret_cast<double*>(carried.contact.data());
    for (std::size_t p = 0; p < contacts.packs(); ++p) {
        unsigned deep = fastest_kernels().touch.hand_on(contacts.pack(p), contacts.record(p), law, records, handed);
        for (; deep != 0; deep &= deep - 1) {
            const std::size_t k = pack_size * p + static_cast<std::size_t>(std::countr_zero(deep));
            const Vec3 u = state.body(contacts.a(k)).velocity - velocity_of_b(k); // solved or not
            const TouchRecord touch = noted(contacts.touch(k), contacts.kind(k), contacts.is_loaded(k),
                -contacts.gap(k) / law.min_diameter, u.dot(contacts.normal(k)), law);
            contacts.set_touch(k, touch);
            carried.contact[contacts.slot(k)].touch = touch;
            if (touch.is_newly_jammed()) ++outcome.newly_jammed;
        }
    }
    for (int lane = 0; lane < pack_size; ++lane) {
        outcome.cone_violation = std::max(outcome.cone_violation, handed.cone_violation[lane]);
        outcome.stored_energy += handed.stored_energy[lane];
        outcome.push_out_energy += handed.push_out_energy[lane];
    }
    if (contacts.has_rolling())
        for (std::size_t k = 0; k < pack_size * contacts.packs(); ++k)
            if (contacts.a(k) >= 0)
                carried.rolling_impulse[contacts.slot(k)] =
                    contacts.hands_nothing_on(k) ? Vec3::Zero().eval() : contacts.rolling_impulse(k);
    return outcome;
}

/// What has touched stays attached.
void carry_attractions(const TileContacts& contacts, CarriedImpulses& carried)
{
    if (!contacts.has_attraction()) return;
    for (const std::size_t k : contacts.indices())
        if (contacts.attracts(k)) carried.contact[contacts.slot(k)].attached = true;
}

void note_walls_touched(const TileContacts& contacts, State& state)
{
    for (const std::size_t k : contacts.indices())
        if (!contacts.impulse(k).isZero(0.0) || contacts.attracts(k)) state.last_wall[contacts.a(k)] = contacts.b(k);
}

/// What walls did to spheres which have moved by h v since.
WallLoad load_from(const TileContacts& walls, const State& state, double h)
{
    WallLoad load;
    for (const std::size_t k : walls.indices()) {
        const std::int32_t a = walls.a(k);
        const Vec3 impulse = walls.impulse(k) + walls.attraction(k);
        const Vec3 point = state.position[a] - h * state.body(a).velocity - state.radius[a] * walls.normal(k);
        load.impulse += impulse;
        load.torque += point.cross(impulse);
        if (walls.has_rolling()) load.torque += walls.rolling_impulse(k);
    }
    return load;
}

} // namespace

ContactOutcome& ContactOutcome::operator+=(const ContactOutcome& other)
{
    cone_violation = std::max(cone_violation, other.cone_violation);
    from_walls += other.from_walls;
    from_pistons += other.from_pistons;
    wall_work += other.wall_work;
    wall_gain_work += other.wall_gain_work;
    push_out_energy += other.push_out_energy;
    stored_energy += other.stored_energy;
    newly_jammed += other.newly_jammed;
    return *this;
}

ContactOutcome carry_impulses(ContactNetwork& network, State& state, const Model& model, const StepLength& length)
{
    const double h = length.h();
    const LawOfStep law = law_of_step(model, length);
    StepContacts& contacts = network.contacts;
    const auto tiles = static_cast<std::int64_t>(contacts.spheres.size());
    std::vector<ContactOutcome> outcomes(contacts.spheres.size());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        auto& outcome = outcomes[tile];
        TileContacts& walls = contacts.walls[tile];
        TileContacts& spheres = contacts.spheres[tile];
        CarriedImpulses& of_tile = network.list.tiles.tiles[tile].carried;
        outcome = carry(spheres, of_tile, state, law, [&](std::size_t k) { return state.body(spheres.b(k)).velocity; });
        outcome += carry(walls, network.carried.walls, state, law,
            [&](std::size_t k) { return walls.has_moving_walls() ? walls.wall(k).velocity : Vec3::Zero().eval(); });
        carry_attractions(spheres, of_tile);
        carry_attractions(walls, network.carried.walls);
        if (walls.has_moving_walls())
            for (const std::size_t k : walls.indices()) {
                const WallRow wall = walls.wall(k);
                const Vec3 impulse = walls.impulse(k);
                outcome.wall_work += (impulse + walls.attraction(k)).dot(wall.velocity);
                // An impact is judged by the velocity that the wall has now, all others by that of before.
                if (walls.kind(k) != ContactKind::impact)
                    outcome.wall_gain_work -= 0.5 * wall.gain * impulse.dot(walls.normal(k));
                if (walls.has_rolling()) outcome.wall_work += walls.rolling_impulse(k).dot(walls.wall(k).spin);
            }
        outcome.from_walls = load_from(walls, state, h);
        note_walls_touched(walls, state);
    }
    ContactOutcome all;
    for (const auto& outcome : outcomes) all += outcome;
    all += carry(contacts.pistons, network.carried.walls, state, law,
        [&](std::size_t k) { return state.pistons[model.walls[contacts.pistons.b(k)].piston].velocity; });
    carry_attractions(contacts.pistons, network.carried.walls);
    all.from_pistons = load_from(contacts.pistons, state, h);
    note_walls_touched(contacts.pistons, state);
    return all;
}

} // namespace talus
