// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/deep_beds/load.hpp"

#include "core/base/disjoint_sets.hpp"
#include "core/solver/whole_contact.hpp"

#include <algorithm>

namespace talus
{
namespace
{

constexpr double sliding_share = 0.999;   ///< of the largest friction: from there on a contact slides
constexpr std::size_t most_networks = 10; ///< none is less than this part of all loads
constexpr std::size_t least_loads = 100;  ///< of a network: grains that fall together are none

/// λ·y, in all and without the rows that slide: their bias, a tangential velocity that friction cannot stop, says
/// nothing of the pressure.
template <bool wall, class R>
void measure_power(Load& load, const WholeContact<wall, R>& own, const Contact& c, const RollingRow& rolling)
{
    const Vec3 u = as_vector(own.velocity());
    const double normal_impulse = c.normal_impulse();
    const double asked = solved_velocity(c.target, c.compliance, c.parting, normal_impulse);
    load.power = normal_impulse * (u.dot(c.normal) - asked);
    load.unsliding = load.power;
    if constexpr (R::friction) {
        const Vec3 tangent = c.impulse - normal_impulse * c.normal;
        const double power = tangent.dot(u);
        load.power += power;
        if (tangent.norm() < sliding_share * c.friction * normal_impulse) load.unsliding += power;
    }
    if constexpr (R::rolling) {
        const double power = (rolling.impulse + rolling.twist * c.normal).dot(as_vector(own.spin()));
        load.power += power;
        if (rolling.impulse.norm() < sliding_share * rolling.reach * normal_impulse) load.unsliding += power;
    }
}

/// A load without its place. @param packs those of the contacts, with the motion of walls
template <bool wall, class R>
Load load_of(const TileContacts& contacts, const PackSpan& packs, std::size_t k, Body* bodies)
{
    const Contact c = contacts.contact(k);
    const RollingRow rolling = R::rolling ? contacts.rolling(k) : RollingRow{};
    Load load;
    measure_power<wall, R>(load, whole_contact<wall, R>(packs, k, bodies), c, rolling);
    load.a = c.a;
    load.impulse = c.impulse;
    if constexpr (!wall) load.b = c.b;
    if constexpr (R::spin) load.turn_a = load.turn_b = -c.arm_scale * c.normal.cross(c.impulse);
    if constexpr (R::rolling) {
        const Vec3 turn = rolling.impulse + rolling.twist * c.normal;
        load.turn_a += turn / bodies[c.a].spin_radius;
        if constexpr (!wall) load.turn_b -= turn / bodies[c.b].spin_radius;
    }
    return load;
}

HatPlace place_of(const TileContacts& contacts, std::size_t k, const State& state, const HatGrid& grid)
{
    const auto a = static_cast<std::size_t>(contacts.a(k));
    return grid.place_of(state.position[a] - state.radius[a] * contacts.normal(k));
}

/// @return behind the last of them
template <bool wall, class R>
Load* find_tile_loads(Load* next, TileContacts& contacts, State& state, const HatGrid& grid)
{
    for (const std::size_t k : contacts.indices()) {
        if (!contacts.is_loaded(k)) continue;
        *next = load_of<wall, R>(contacts, contacts.span(), k, state.bodies.data());
        next++->place = place_of(contacts, k, state, grid);
    }
    return next;
}

std::size_t count_loads(const TileContacts& contacts)
{
    return static_cast<std::size_t>(
        std::ranges::count_if(contacts.indices(), [&](std::size_t k) { return contacts.is_loaded(k); }));
}

/// For its contacts a piston is a wall that moves as it does.
template <class R>
void append_piston_loads(Loads& loads, ContactNetwork& network, const PistonGroup& pistons, State& state,
    const Model& model, const HatGrid& grid)
{
    using AtWalls = Rows<R::friction, R::spin, R::rolling, true>;
    TileContacts& contacts = network.contacts.pistons;
    std::vector<WallPack> moves(contacts.packs());
    PackSpan packs = contacts.span();
    packs.wall = moves.data();
    for (const std::size_t k : contacts.indices()) {
        const auto piston = model.walls[contacts.b(k)].piston;
        const WallRow row = pistons.motion_at(static_cast<std::size_t>(piston), network.contacts.piston_arms[k]);
        for (int d = 0; d < 3; ++d) {
            moves[k / pack_size].velocity[d][k % pack_size] = row.velocity[d];
            moves[k / pack_size].spin[d][k % pack_size] = row.spin[d];
        }
        Load& load = loads.list.emplace_back(load_of<true, AtWalls>(contacts, packs, k, state.bodies.data()));
        load.piston = piston;
        load.place = place_of(contacts, k, state, grid);
    }
}

template <class R>
Loads find_loads(
    ContactNetwork& network, const PistonGroup& pistons, State& state, const Model& model, const HatGrid& grid)
{
    const auto tiles = static_cast<std::int64_t>(network.list.tiles.count());
    Loads loads;
    loads.first.assign(network.list.tiles.count() + 1, 0);
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        loads.first[tile + 1] = count_loads(network.contacts.spheres[tile]) + count_loads(network.contacts.walls[tile]);
    }
    std::partial_sum(loads.first.begin(), loads.first.end(), loads.first.begin());
    loads.list.resize(loads.first.back());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        Load* const at_walls = find_tile_loads<false, R>(
            loads.list.data() + loads.first[tile], network.contacts.spheres[tile], state, grid);
        find_tile_loads<true, R>(at_walls, network.contacts.walls[tile], state, grid);
    }
    if (!pistons.empty()) append_piston_loads<R>(loads, network, pistons, state, model, grid);
    return loads;
}

} // namespace

std::vector<std::vector<std::uint32_t>> networks_of(const Loads& loads, std::size_t spheres, std::size_t pistons)
{
    DisjointSets bodies(spheres + pistons);
    for (const Load& load : loads.list) {
        if (load.b >= 0) bodies.join(static_cast<std::size_t>(load.a), static_cast<std::size_t>(load.b));
        if (load.piston >= 0)
            bodies.join(static_cast<std::size_t>(load.a), spheres + static_cast<std::size_t>(load.piston));
    }
    std::vector<std::size_t> size(spheres + pistons, 0);
    for (const Load& load : loads.list) ++size[bodies.first_of_set(static_cast<std::size_t>(load.a))];
    std::vector<std::size_t> large;
    for (std::size_t body = 0; body < size.size(); ++body)
        if (size[body] >= least_loads && most_networks * size[body] >= loads.list.size()) large.push_back(body);
    std::ranges::stable_sort(large, [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
    std::vector<std::size_t> number(spheres + pistons, 0);
    for (std::size_t n = 0; n < large.size(); ++n) number[large[n]] = n;
    std::vector<std::vector<std::uint32_t>> networks(std::max<std::size_t>(1, large.size()));
    for (std::uint32_t k = 0; k < loads.list.size(); ++k)
        networks[number[bodies.first_of_set(static_cast<std::size_t>(loads.list[k].a))]].push_back(k);
    return networks;
}

Loads part_of(const Loads& loads, const std::vector<std::uint32_t>& places)
{
    Loads part;
    for (const std::uint32_t k : places) part.list.push_back(loads.list[k]);
    const auto at_pistons = std::ranges::lower_bound(places, loads.first_of_pistons());
    part.first = {static_cast<std::size_t>(at_pistons - places.begin())};
    return part;
}

Loads find_loads(
    ContactNetwork& network, const PistonGroup& pistons, State& state, const Model& model, const HatGrid& grid)
{
    return with_rows(
        model.physics, [&](auto rows) { return find_loads<decltype(rows)>(network, pistons, state, model, grid); });
}

} // namespace talus
