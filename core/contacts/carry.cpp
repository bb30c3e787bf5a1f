// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/carry.hpp"

#include "core/contacts/press_count.hpp"

#include <algorithm>

namespace talus
{
namespace
{

/// Tells which contacts are pressed (press_count.hpp); none with `matched`, whose contacts give way, none at pistons,
/// and none where no wall moves as told: to stand still obeys every contact then.
struct PressGauge {
    const std::vector<Motion>& motion;
    double overlap; ///< [m]
    double closing; ///< [m/s]

    PressGauge(const State& state, const Model& model)
        : motion(state.motion),
          overlap(model.solver.stabilisation == Stabilisation::projected && model.physics.moving_walls
                      ? pressed_overlap * model.min_diameter
                      : infinity),
          closing(pressed_closing * model.min_diameter / model.time_step)
    {
    }

    bool is_deep(const ContactGeometry& geometry) const { return -geometry.gap > overlap; }

    bool sees(const ContactArrays& arrays, std::size_t k, bool at_wall) const
    {
        if (!is_deep(arrays.geometry[k])) return false;
        const Contact& c = arrays.contact[k];
        Vec3 u = motion[c.a].velocity;
        if (!at_wall) u -= motion[c.b].velocity;
        if (!arrays.wall.empty()) u -= arrays.wall[k].velocity;
        return c.impulse.dot(c.normal) > 0.0 && u.dot(c.normal) < -closing;
    }
};

/// Worst excess of the tangential impulse over the cone; carries the impulses of one tile's contacts of one kind.
ContactOutcome carry(const ContactArrays& arrays, std::size_t first, std::size_t count, CarriedImpulses& carried,
    const PressGauge& gauge, bool at_wall)
{
    ContactOutcome outcome;
    for (std::size_t k = first; k < first + count; ++k) {
        const auto& contact = arrays.contact[k];
        const auto& geometry = arrays.geometry[k];
        const bool keeps = geometry.kind != ContactKind::impact;
        const double normal_impulse = contact.impulse.dot(contact.normal);
        const double tangent_impulse = (contact.impulse - normal_impulse * contact.normal).norm();
        outcome.cone_violation =
            std::max(outcome.cone_violation, tangent_impulse - arrays.terms[k].friction * normal_impulse);
        std::uint8_t& touched = carried.touched[geometry.slot];
        const bool pressed = gauge.sees(arrays, k, at_wall);
        const bool opened = geometry.kind == ContactKind::open; // and closed by the impacts of others, if it was fast
        if (pressed)
            touched = count_pressed(touched);
        else if (gauge.is_deep(geometry))
            touched = count_unpressed(touched);
        else
            touched = geometry.gap <= 0.0 || (normal_impulse > 0.0 && !opened);
        if (pressed && came_beyond_solution(touched)) ++outcome.beyond_solution;
        carried.impulse[geometry.slot] = keeps ? contact.impulse : Vec3::Zero().eval();
        if (!arrays.rolling.empty())
            carried.rolling_impulse[geometry.slot] = keeps ? arrays.rolling[k].impulse : Vec3::Zero().eval();
    }
    return outcome;
}

void note_walls_touched(const ContactArrays& arrays, std::size_t first, std::size_t count, State& state)
{
    for (std::size_t k = first; k < first + count; ++k)
        if (!arrays.contact[k].impulse.isZero(0.0)) state.last_wall[arrays.contact[k].a] = arrays.contact[k].b;
}

} // namespace

ContactOutcome& ContactOutcome::operator+=(const ContactOutcome& other)
{
    cone_violation = std::max(cone_violation, other.cone_violation);
    wall_impulse += other.wall_impulse;
    wall_work += other.wall_work;
    beyond_solution += other.beyond_solution;
    return *this;
}

ContactOutcome carry_impulses(ContactNetwork& network, State& state, const Model& model)
{
    const PressGauge gauge(state, model);
    const auto tiles = static_cast<std::int64_t>(network.tiles.count());
    std::vector<ContactOutcome> outcomes(network.tiles.count());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        auto& outcome = outcomes[tile];
        const auto first = network.wall_slots_of_tile[tile];
        const auto& walls = network.wall_contacts;
        outcome = carry(network.sphere_contacts, network.pairs_of_tile[tile], network.sphere_contacts.count[tile],
            network.pair_carried, gauge, false);
        outcome += carry(walls, first, walls.count[tile], network.wall_carried, gauge, true);
        for (std::size_t k = first; k < first + walls.count[tile]; ++k) {
            outcome.wall_impulse += walls.contact[k].impulse;
            if (!walls.wall.empty()) outcome.wall_work += walls.contact[k].impulse.dot(walls.wall[k].velocity);
            if (!walls.wall.empty() && !walls.rolling.empty())
                outcome.wall_work += walls.rolling[k].impulse.dot(walls.wall[k].spin);
        }
        note_walls_touched(walls, first, walls.count[tile], state);
    }
    ContactOutcome all;
    for (const auto& outcome : outcomes) all += outcome;
    if (!network.piston_contacts.contact.empty()) {
        const auto& pistons = network.piston_contacts;
        PressGauge none = gauge; // a piston gives way
        none.overlap = infinity;
        all += carry(pistons, 0, pistons.count[0], network.wall_carried, none, true);
        note_walls_touched(pistons, 0, pistons.count[0], state);
    }
    return all;
}

} // namespace talus
