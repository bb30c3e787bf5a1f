// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/carry.hpp"

#include "core/packs/kernels.hpp"

#include <algorithm>
#include <bit>

namespace talus
{
namespace
{

/// A contact closes under load when it has an impulse that does not keep it from closing by so many smallest diameters
/// in the step. A rigid one that is deep enough counts as pressed then, a compliant one as crushed (TouchRecord).
constexpr double pressed_closing = 1e-8;

/// Tells which contacts are loaded or pressed; none is pressed at pistons, which give way, and none where no wall moves
/// as told: to stand still obeys every contact then.
struct PressGauge {
    const std::vector<Motion>& motion;
    bool rigid;     ///< `projected`
    double overlap; ///< from which on a contact can be pressed [m]
    double crushed; ///< the same of a compliant one [m]
    double closing; ///< [m/s]

    PressGauge(const State& state, const Model& model, double h)
        : motion(state.motion), rigid(model.solver.stabilisation == Stabilisation::projected),
          overlap(model.physics.moving_walls ? pressed_overlap * model.min_diameter : infinity),
          crushed(crushed_overlap * model.min_diameter), closing(pressed_closing * model.min_diameter / h)
    {
    }

    /// What this step adds to the record of a contact.
    TouchRecord noted(const TileContacts& contacts, std::size_t k, bool at_wall) const
    {
        const ContactGeometry geometry = contacts.geometry(k);
        TouchRecord touch = geometry.touch;
        const bool loaded = geometry.kind != ContactKind::impact && normal_impulse(contacts, k) > 0.0;
        if (-geometry.gap <= overlap)
            touch.note_load(loaded);
        else if (rigid)
            closes_under_load(contacts, k, at_wall) ? touch.note_pressed() : touch.note_unpressed();
        else
            touch.is_jammed() || is_crushed(contacts, k, at_wall) ? touch.note_crushed() : touch.note_load(loaded);
        return touch;
    }

private:
    static double normal_impulse(const TileContacts& contacts, std::size_t k)
    {
        return contacts.impulse(k).dot(contacts.normal(k));
    }

    bool is_crushed(const TileContacts& contacts, std::size_t k, bool at_wall) const
    {
        return -contacts.geometry(k).gap > crushed && closes_under_load(contacts, k, at_wall);
    }

    bool closes_under_load(const TileContacts& contacts, std::size_t k, bool at_wall) const
    {
        Vec3 u = motion[contacts.a(k)].velocity;
        if (!at_wall) u -= motion[contacts.b(k)].velocity;
        if (contacts.has_moving_walls()) u -= contacts.wall(k).velocity;
        return normal_impulse(contacts, k) > 0.0 && u.dot(contacts.normal(k)) < -closing;
    }
};

/// What the contacts between the spheres of a tile hand on.
ContactOutcome carry_between_spheres(TileContacts& contacts, CarriedImpulses& carried, const PressGauge& gauge)
{
    ContactOutcome outcome;
    auto* const records = reinterpret_cast<double*>(carried.contact.data());
    for (std::size_t p = 0; p < contacts.packs(); ++p) {
        unsigned deep = 0;
        const double excess =
            fastest_kernels().touch.hand_on(contacts.pack(p), contacts.record(p), gauge.overlap, deep, records);
        outcome.cone_violation = std::max(outcome.cone_violation, excess);
        for (; deep != 0; deep &= deep - 1) {
            const std::size_t k = pack_size * p + static_cast<std::size_t>(std::countr_zero(deep));
            const TouchRecord touch = gauge.noted(contacts, k, false);
            contacts.set_touch(k, touch);
            carried.contact[contacts.geometry(k).slot].touch = touch;
            if (touch.is_newly_jammed()) ++outcome.newly_jammed;
        }
    }
    if (contacts.has_rolling())
        for (std::size_t k = 0; k < pack_size * contacts.packs(); ++k)
            if (contacts.a(k) >= 0)
                carried.rolling_impulse[contacts.geometry(k).slot] =
                    contacts.kind(k) == ContactKind::impact ? Vec3::Zero().eval() : contacts.rolling_impulse(k);
    return outcome;
}

/// The same of those with walls, one by one.
ContactOutcome carry_at_walls(TileContacts& contacts, CarriedImpulses& carried, const PressGauge& gauge)
{
    ContactOutcome outcome;
    for (const std::size_t k : contacts.indices()) {
        const Vec3 impulse = contacts.impulse(k), normal = contacts.normal(k);
        const double normal_impulse = impulse.dot(normal);
        const double tangent_impulse = (impulse - normal_impulse * normal).norm();
        outcome.cone_violation =
            std::max(outcome.cone_violation, tangent_impulse - contacts.friction(k) * normal_impulse);
        const TouchRecord touch = gauge.noted(contacts, k, true);
        contacts.set_touch(k, touch);
        if (touch.is_newly_jammed()) ++outcome.newly_jammed;
        const ContactGeometry own = contacts.geometry(k);
        const bool keeps = own.kind != ContactKind::impact;
        carried.contact[own.slot].impulse = keeps ? impulse : Vec3::Zero().eval();
        carried.contact[own.slot].compression = own.compression;
        carried.contact[own.slot].touch = touch;
        if (contacts.has_rolling())
            carried.rolling_impulse[own.slot] = keeps ? contacts.rolling_impulse(k) : Vec3::Zero().eval();
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
    newly_jammed += other.newly_jammed;
    return *this;
}

ContactOutcome carry_impulses(ContactNetwork& network, State& state, const Model& model, double h)
{
    network.carried.step_before = h;
    const PressGauge gauge(state, model, h);
    StepContacts& contacts = network.contacts;
    const auto tiles = static_cast<std::int64_t>(contacts.spheres.size());
    std::vector<ContactOutcome> outcomes(contacts.spheres.size());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        auto& outcome = outcomes[tile];
        TileContacts& walls = contacts.walls[tile];
        outcome = carry_between_spheres(contacts.spheres[tile], network.list.tiles.tiles[tile].carried, gauge);
        outcome += carry_at_walls(walls, network.carried.walls, gauge);
        if (walls.has_moving_walls())
            for (const std::size_t k : walls.indices()) {
                outcome.wall_work += walls.impulse(k).dot(walls.wall(k).velocity);
                if (walls.has_rolling()) outcome.wall_work += walls.rolling_impulse(k).dot(walls.wall(k).spin);
            }
        outcome.from_walls = load_from(walls, state, h);
        note_walls_touched(walls, state);
    }
    ContactOutcome all;
    for (const auto& outcome : outcomes) all += outcome;
    PressGauge none = gauge; // a piston gives way
    none.overlap = infinity;
    all += carry_at_walls(contacts.pistons, network.carried.walls, none);
    all.from_pistons = load_from(contacts.pistons, state, h);
    note_walls_touched(contacts.pistons, state);
    return all;
}

} // namespace talus
