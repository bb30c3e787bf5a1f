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

/// What this step adds to the record of a contact.
/// @param velocity_of_b what this says of contact k, after the step [m/s]
template <class VelocityOfB>
TouchRecord noted(const TileContacts& contacts, std::size_t k, const State& state, const LawOfStep& law,
    const VelocityOfB& velocity_of_b)
{
    const ContactGeometry geometry = contacts.geometry(k);
    const double along = contacts.impulse(k).dot(contacts.normal(k));
    const double overlap = -geometry.gap / law.min_diameter;
    TouchRecord touch = geometry.touch;
    if (along > 0.0 && geometry.kind == ContactKind::impact)
        touch.note_impact();
    else if (along > 0.0 && geometry.kind == ContactKind::open)
        touch.note_closing();
    else
        touch.note_load(along > 0.0 || geometry.kind == ContactKind::yielding);
    const double pressed = law.rigid ? rigid_yield_overlap : pressed_overlap;
    if (overlap <= pressed && !(touch.is_jammed() && overlap > jammed_overlap)) {
        touch.note_hold();
        return touch;
    }
    const Vec3 u = state.motion[contacts.a(k)].velocity - velocity_of_b(k); // solved or not
    const bool deepens = along > 0.0 && u.dot(contacts.normal(k)) < 0.0;
    touch.note_yield(deepens, overlap > jamming_overlap);
    return touch;
}

/// What the contacts between the spheres of a tile hand on.
ContactOutcome carry_between_spheres(
    TileContacts& contacts, CarriedImpulses& carried, const State& state, const LawOfStep& law)
{
    ContactOutcome outcome;
    auto* const records = reinterpret_cast<double*>(carried.contact.data());
    for (std::size_t p = 0; p < contacts.packs(); ++p) {
        HandedOn handed = fastest_kernels().touch.hand_on(contacts.pack(p), contacts.record(p), law, records);
        outcome.cone_violation = std::max(outcome.cone_violation, handed.cone_violation);
        outcome.stored_energy += handed.stored_energy;
        outcome.push_out_energy += handed.push_out_energy;
        for (unsigned lanes = handed.deep_lanes; lanes != 0; lanes &= lanes - 1) {
            const std::size_t k = pack_size * p + static_cast<std::size_t>(std::countr_zero(lanes));
            const TouchRecord touch =
                noted(contacts, k, state, law, [&](std::size_t j) { return state.motion[contacts.b(j)].velocity; });
            contacts.set_touch(k, touch);
            carried.contact[contacts.geometry(k).slot].touch = touch;
            if (touch.is_newly_jammed()) ++outcome.newly_jammed;
        }
    }
    if (contacts.has_rolling())
        for (std::size_t k = 0; k < pack_size * contacts.packs(); ++k)
            if (contacts.a(k) >= 0)
                carried.rolling_impulse[contacts.geometry(k).slot] =
                    contacts.geometry(k).hands_on == 0.0F ? Vec3::Zero().eval() : contacts.rolling_impulse(k);
    return outcome;
}

/// The same of those with walls, one by one.
template <class VelocityOfB>
ContactOutcome carry_at_walls(TileContacts& contacts, CarriedImpulses& carried, const State& state,
    const LawOfStep& law, const VelocityOfB& velocity_of_b)
{
    ContactOutcome outcome;
    for (const std::size_t k : contacts.indices()) {
        const Vec3 impulse = contacts.impulse(k), normal = contacts.normal(k);
        const ContactTerms terms = contacts.terms(k);
        const double along = impulse.dot(normal), tangent_impulse = (impulse - along * normal).norm();
        outcome.cone_violation = std::max(outcome.cone_violation, tangent_impulse - terms.friction * along);
        const TouchRecord touch = noted(contacts, k, state, law, velocity_of_b);
        contacts.set_touch(k, touch);
        if (touch.is_newly_jammed()) ++outcome.newly_jammed;

        const ContactGeometry own = contacts.geometry(k);
        const double u_n = solved_velocity<double>(contacts.contact(k).target, terms.compliance, terms.parting, along);
        const double kappa = compression_after<double>(own.compression, own.gap, u_n, along, own.restitution, law);
        const bool keeps_spring = kappa > touching_gap * law.min_diameter;
        outcome.push_out_energy += own.push * along;
        if (keeps_spring)
            outcome.stored_energy += spring_energy<double>(kappa, u_n, own.spring, terms.inverse_mass_sum, law);
        carried.contact[own.slot].impulse = (along > own.hands_on ? own.hands_on / along : 1.0) * impulse;
        carried.contact[own.slot].compression = static_cast<float>(handed_on<double>(kappa, u_n, law));
        carried.contact[own.slot].touch = touch;
        if (contacts.has_rolling())
            carried.rolling_impulse[own.slot] =
                own.hands_on == 0.0F ? Vec3::Zero().eval() : contacts.rolling_impulse(k);
    }
    return outcome;
}

void note_walls_touched(const TileContacts& contacts, State& state)
{
    for (const std::size_t k : contacts.indices())
        if (!contacts.impulse(k).isZero(0.0)) state.last_wall[contacts.a(k)] = contacts.b(k);
}

/// What walls did to spheres which have moved by h v since.
WallLoad load_from(const TileContacts& walls, const State& state, double h)
{
    WallLoad load;
    for (const std::size_t k : walls.indices()) {
        const std::int32_t a = walls.a(k);
        const Vec3 impulse = walls.impulse(k);
        const Vec3 point = state.position[a] - h * state.motion[a].velocity - state.radius(a) * walls.normal(k);
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
        outcome = carry_between_spheres(contacts.spheres[tile], network.list.tiles.tiles[tile].carried, state, law);
        outcome += carry_at_walls(walls, network.carried.walls, state, law,
            [&](std::size_t k) { return walls.has_moving_walls() ? walls.wall(k).velocity : Vec3::Zero().eval(); });
        if (walls.has_moving_walls())
            for (const std::size_t k : walls.indices()) {
                const WallRow wall = walls.wall(k);
                const Vec3 impulse = walls.impulse(k);
                outcome.wall_work += impulse.dot(wall.velocity);
                outcome.wall_gain_work -= 0.5 * wall.gain * impulse.dot(walls.normal(k));
                if (walls.has_rolling()) outcome.wall_work += walls.rolling_impulse(k).dot(walls.wall(k).spin);
            }
        outcome.from_walls = load_from(walls, state, h);
        note_walls_touched(walls, state);
    }
    ContactOutcome all;
    for (const auto& outcome : outcomes) all += outcome;
    all += carry_at_walls(contacts.pistons, network.carried.walls, state, law,
        [&](std::size_t k) { return state.pistons[model.walls[contacts.pistons.b(k)].piston].velocity; });
    all.from_pistons = load_from(contacts.pistons, state, h);
    note_walls_touched(contacts.pistons, state);
    return all;
}

} // namespace talus
