// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

#include <algorithm>

namespace talus
{
namespace
{

constexpr int most_sub_steps = 1024; ///< a hundred diameters in a step: what comes faster is beyond any sense

bool goes_on(const StepReport& report)
{
    return std::ranges::all_of(report.bodies.incidents, [](const Incident& incident) {
        return incident.kind == Incident::Kind::escaped || incident.kind == Incident::Kind::pressed ||
               incident.is_harmless();
    });
}

/// Of the contacts of the network that close in a step of length h [s], which has not been solved.
Approach fastest_approach(const State& state, const ContactNetwork& network, const Model& model, double h)
{
    Approach fastest;
    const double touching = touching_gap * model.min_diameter;
    const auto look = [&](const TileContacts& contacts, bool with_walls, auto&& velocity_of_b) {
        for (const std::size_t k : contacts.indices()) {
            const std::int32_t a = contacts.a(k), b = contacts.b(k);
            const double speed = -contacts.normal(k).dot(state.body(a).velocity - velocity_of_b(k));
            if (speed > fastest.speed && contacts.gap(k) - h * speed <= touching)
                fastest = {speed, state.id[a], with_walls ? -1 : state.id[b], with_walls ? b : -1};
        }
    };
    for (const TileContacts& tile : network.contacts.spheres)
        look(tile, false, [&](std::size_t k) { return state.body(tile.b(k)).velocity; });
    for (const TileContacts& tile : network.contacts.walls)
        look(tile, true,
            [&](std::size_t k) { return tile.has_moving_walls() ? tile.wall(k).velocity : Vec3::Zero().eval(); });
    const TileContacts& pistons = network.contacts.pistons;
    look(pistons, true, [&](std::size_t k) {
        const PistonState& own = state.pistons[model.walls[pistons.b(k)].piston];
        return Vec3(own.velocity + own.spin.cross(network.contacts.piston_arms[k]));
    });
    return fastest;
}

} // namespace

StepReport advance(State& state, ContactNetwork& network, const Model& model, const PhaseObserver& observer)
{
    std::optional<StepReport> whole;
    Approach asked;
    int count = 1, made = 0;
    while (made < count && (!whole || goes_on(*whole))) {
        const bool in_any_case = 2 * count > most_sub_steps;
        const StepLength length{model.time_step, count};
        auto report = advance_once(length, in_any_case, state, network, model, observer);
        if (!report) {
            const Approach fastest = fastest_approach(state, network, model, length.h());
            if (fastest.speed > asked.speed) asked = fastest;
            count *= 2;
            made *= 2;
            continue;
        }
        ++made;
        if (whole)
            whole->then(*std::move(report));
        else
            whole = std::move(report);
    }
    if (count > 1) {
        whole->sub_steps = count;
        whole->split_for = asked;
        StepLength{model.time_step}.pass(state);
    }
    return *std::move(whole);
}

} // namespace talus
