// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pressure_scaling/load.hpp"

#include "core/solver/contact_kernel.hpp"

#include <numeric>

namespace talus
{
namespace
{

constexpr double sliding_share = 0.999; ///< of the largest friction: from there on a contact slides

/// λ·y, in all and without the rows that slide: their bias, a tangential velocity that friction cannot stop, says
/// nothing of the pressure.
template <bool wall, class R>
void measure_power(Load& load, const Contact& c, const ContactTerms& terms, const SideRows& rows, const Motion* motion)
{
    const Vec3 u = contact_velocity<wall, R>(c, terms, rows, motion);
    const double normal_impulse = c.impulse.dot(c.normal);
    load.power = normal_impulse * (u.dot(c.normal) - c.target + terms.compliance * normal_impulse);
    load.unsliding = load.power;
    if constexpr (R::friction) {
        const Vec3 tangent = c.impulse - normal_impulse * c.normal;
        const double power = tangent.dot(u);
        load.power += power;
        if (tangent.norm() < sliding_share * terms.friction * normal_impulse) load.unsliding += power;
    }
    if constexpr (R::rolling) {
        const RollingRow& rolling = *rows.rolling;
        const double power = rolling.impulse.dot(relative_spin<wall, R>(c, rows, motion));
        load.power += power;
        if (rolling.impulse.norm() < sliding_share * rolling.reach * normal_impulse) load.unsliding += power;
    }
}

template <bool wall, class R>
void measure_effect(Load& load, const Contact& c, const ContactTerms& terms, const SideRows& rows, const Motion* motion)
{
    load.a = c.a;
    load.impulse = c.impulse;
    if constexpr (!wall) load.b = c.b;
    if constexpr (R::spin) load.turn_a = load.turn_b = -terms.arm_scale * c.normal.cross(c.impulse);
    if constexpr (R::rolling) {
        load.turn_a += rows.rolling->impulse / motion[c.a].radius;
        if constexpr (!wall) load.turn_b -= rows.rolling->impulse / motion[c.b].radius;
    }
}

HatPlace place_of(const Contact& c, const State& state, const HatGrid& grid)
{
    return grid.place_of(state.position[c.a] - state.radius(static_cast<std::size_t>(c.a)) * c.normal);
}

template <class R>
void find_tile_loads(Load* next, ContactNetwork& network, std::size_t tile, const State& state, const HatGrid& grid)
{
    const Motion* motion = state.motion.data();
    for_each_contact(
        network.contacts, tile, [&](const Contact& c, const ContactTerms& terms, const SideRows& rows, auto is_wall) {
            if (!is_loaded(c)) return;
            Load& load = *next++;
            load.place = place_of(c, state, grid);
            measure_power<is_wall(), R>(load, c, terms, rows, motion);
            measure_effect<is_wall(), R>(load, c, terms, rows, motion);
        });
}

template <class R>
void append_piston_loads(Loads& loads, const ContactNetwork& network, const PistonGroup& pistons, const State& state,
    const Model& model, const HatGrid& grid)
{
    // For its contacts a piston is a wall that moves as it does.
    using AtWalls = Rows<R::friction, R::spin, R::rolling, true>;
    const ContactArrays& contacts = network.contacts.pistons;
    for (const std::size_t k : contacts.of_tile(0)) {
        const Contact& c = contacts.contact[k];
        const auto piston = model.walls[c.b].piston;
        const WallRow wall = pistons.motion_at(static_cast<std::size_t>(piston), network.contacts.piston_arms[k]);
        RollingRow rolling = R::rolling ? contacts.rolling[k] : RollingRow{};
        const SideRows rows{&rolling, &wall};
        Load& load = loads.list.emplace_back();
        load.piston = piston;
        load.place = place_of(c, state, grid);
        measure_power<true, AtWalls>(load, c, contacts.terms[k], rows, state.motion.data());
        measure_effect<true, AtWalls>(load, c, contacts.terms[k], rows, state.motion.data());
    }
}

template <class R>
Loads find_loads(
    ContactNetwork& network, const PistonGroup& pistons, const State& state, const Model& model, const HatGrid& grid)
{
    const auto tiles = static_cast<std::int64_t>(network.list.tiles.count());
    Loads loads;
    loads.first.assign(network.list.tiles.count() + 1, 0);
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        for_each_contact(network.contacts, tile, [&](const Contact& c, const ContactTerms&, const SideRows&, auto) {
            loads.first[tile + 1] += is_loaded(c);
        });
    }
    std::partial_sum(loads.first.begin(), loads.first.end(), loads.first.begin());
    loads.list.resize(loads.first.back());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        find_tile_loads<R>(loads.list.data() + loads.first[tile], network, tile, state, grid);
    }
    if (!pistons.empty()) append_piston_loads<R>(loads, network, pistons, state, model, grid);
    return loads;
}

} // namespace

Loads find_loads(
    ContactNetwork& network, const PistonGroup& pistons, const State& state, const Model& model, const HatGrid& grid)
{
    return with_rows(
        model.physics, [&](auto rows) { return find_loads<decltype(rows)>(network, pistons, state, model, grid); });
}

} // namespace talus
