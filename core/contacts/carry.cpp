// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/carry.hpp"

#include <algorithm>

namespace talus
{
namespace
{

/// A contact closes under load when it has an impulse that does not keep it from closing by so many smallest diameters
/// in the step. A rigid one that is deep enough counts as pressed then, a compliant one as crushed (TouchRecord).
constexpr double pressed_closing = 1e-8;

/// Tells which contacts are pressed; none at pistons, which give way, and none where no wall moves as told: to stand
/// still obeys every contact then.
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

    void note(TouchRecord& touch, const ContactArrays& arrays, std::size_t k, bool at_wall) const
    {
        const ContactGeometry& geometry = arrays.geometry[k];
        const bool loaded = geometry.kind != ContactKind::impact && normal_impulse(arrays.contact[k]) > 0.0;
        if (-geometry.gap <= overlap)
            touch.note_load(loaded);
        else if (rigid)
            closes_under_load(arrays, k, at_wall) ? touch.note_pressed() : touch.note_unpressed();
        else
            touch.is_jammed() || is_crushed(arrays, k, at_wall) ? touch.note_crushed() : touch.note_load(loaded);
    }

private:
    static double normal_impulse(const Contact& c) { return c.impulse.dot(c.normal); }

    bool is_crushed(const ContactArrays& arrays, std::size_t k, bool at_wall) const
    {
        return -arrays.geometry[k].gap > crushed && closes_under_load(arrays, k, at_wall);
    }

    bool closes_under_load(const ContactArrays& arrays, std::size_t k, bool at_wall) const
    {
        const Contact& c = arrays.contact[k];
        Vec3 u = motion[c.a].velocity;
        if (!at_wall) u -= motion[c.b].velocity;
        if (!arrays.wall.empty()) u -= arrays.wall[k].velocity;
        return normal_impulse(c) > 0.0 && u.dot(c.normal) < -closing;
    }
};

/// Worst excess of the tangential impulse over the cone; carries the impulses of one tile's contacts of one kind.
ContactOutcome carry(
    const ContactArrays& arrays, std::size_t tile, CarriedImpulses& carried, const PressGauge& gauge, bool at_wall)
{
    ContactOutcome outcome;
    for (const std::size_t k : arrays.of_tile(tile)) {
        const auto& contact = arrays.contact[k];
        const auto& geometry = arrays.geometry[k];
        const bool keeps = geometry.kind != ContactKind::impact;
        const double normal_impulse = contact.impulse.dot(contact.normal);
        const double tangent_impulse = (contact.impulse - normal_impulse * contact.normal).norm();
        outcome.cone_violation =
            std::max(outcome.cone_violation, tangent_impulse - arrays.terms[k].friction * normal_impulse);
        TouchRecord& touch = carried.touch[geometry.slot];
        gauge.note(touch, arrays, k, at_wall);
        if (touch.is_newly_jammed()) ++outcome.newly_jammed;
        carried.impulse[geometry.slot] = keeps ? contact.impulse : Vec3::Zero().eval();
        if (!arrays.rolling.empty())
            carried.rolling_impulse[geometry.slot] = keeps ? arrays.rolling[k].impulse : Vec3::Zero().eval();
    }
    return outcome;
}

void note_walls_touched(const ContactArrays& arrays, std::size_t tile, State& state)
{
    for (const std::size_t k : arrays.of_tile(tile))
        if (!arrays.contact[k].impulse.isZero(0.0)) state.last_wall[arrays.contact[k].a] = arrays.contact[k].b;
}

} // namespace

ContactOutcome& ContactOutcome::operator+=(const ContactOutcome& other)
{
    cone_violation = std::max(cone_violation, other.cone_violation);
    wall_impulse += other.wall_impulse;
    wall_work += other.wall_work;
    newly_jammed += other.newly_jammed;
    return *this;
}

ContactOutcome carry_impulses(ContactNetwork& network, State& state, const Model& model, double h)
{
    const PressGauge gauge(state, model, h);
    const auto& [spheres, walls, pistons, arms] = network.contacts;
    const auto tiles = static_cast<std::int64_t>(spheres.tiles());
    std::vector<ContactOutcome> outcomes(spheres.tiles());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        auto& outcome = outcomes[tile];
        outcome = carry(spheres, tile, network.carried.pairs, gauge, false);
        outcome += carry(walls, tile, network.carried.walls, gauge, true);
        for (const std::size_t k : walls.of_tile(tile)) {
            outcome.wall_impulse += walls.contact[k].impulse;
            if (!walls.wall.empty()) outcome.wall_work += walls.contact[k].impulse.dot(walls.wall[k].velocity);
            if (!walls.wall.empty() && !walls.rolling.empty())
                outcome.wall_work += walls.rolling[k].impulse.dot(walls.wall[k].spin);
        }
        note_walls_touched(walls, tile, state);
    }
    ContactOutcome all;
    for (const auto& outcome : outcomes) all += outcome;
    if (!pistons.empty()) {
        PressGauge none = gauge; // a piston gives way
        none.overlap = infinity;
        all += carry(pistons, 0, network.carried.walls, none, true);
        note_walls_touched(pistons, 0, state);
    }
    return all;
}

} // namespace talus
