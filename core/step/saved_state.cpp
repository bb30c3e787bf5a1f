// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/saved_state.hpp"

#include "core/base/archive.hpp"
#include "core/world/placed_wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace talus
{
namespace
{

/// Whether all lists have so many elements.
bool are_long(std::size_t count, const auto&... lists)
{
    return ((lists.size() == count) && ...);
}

/// Whether all numbers of a list are indices into another of this length, from `least` on.
bool are_indices(const auto& list, std::size_t length, std::int64_t least = 0)
{
    return std::ranges::all_of(list, [&](auto index) {
        return static_cast<std::int64_t>(index) >= least &&
               static_cast<std::int64_t>(index) < static_cast<std::int64_t>(length);
    });
}

/// Whether a list says where the parts begin into which so many elements are divided, and where the last ends.
bool divides(const std::vector<std::uint32_t>& first, std::size_t parts, std::size_t elements)
{
    return first.size() == parts + 1 && first.front() == 0 && first.back() == elements && std::ranges::is_sorted(first);
}

/// Whether [first, first + count) is part of a list of this length, for each sphere.
bool are_ranges(const std::vector<std::uint32_t>& first, const std::vector<std::uint32_t>& count, std::size_t length)
{
    if (first.size() != count.size()) return false;
    for (std::size_t i = 0; i < first.size(); ++i)
        if (std::uint64_t{first[i]} + count[i] > length) return false;
    return true;
}

bool is_body(const Motion& m)
{
    return m.velocity.allFinite() && m.rim_velocity.allFinite() && std::isfinite(m.radius) && m.radius > 0.0 &&
           std::isfinite(m.inverse_mass) && m.inverse_mass > 0.0;
}

bool are_spheres(const State& state, const Model& model)
{
    const std::size_t n = state.count();
    const auto finite = [](const Vec3& x) { return x.allFinite(); };
    return are_long(n, state.position, state.position_rest, state.motion, state.material, state.id, state.last_wall,
               state.leaving) &&
           are_indices(state.material, model.materials.list.size()) &&
           are_indices(state.last_wall, model.walls.size(), -1) && state.pistons.size() == model.pistons.size() &&
           std::ranges::all_of(state.position, finite) && std::ranges::all_of(state.position_rest, finite) &&
           std::ranges::all_of(state.motion, is_body) && std::isfinite(state.time) && state.steps >= 0;
}

bool are_carried(const CarriedImpulses& carried, std::size_t slots, const Model& model)
{
    return are_long(slots, carried.impulse, carried.touched) &&
           carried.rolling_impulse.size() == (model.physics.rolling ? slots : 0);
}

bool are_tiles(const Tiles& tiles, std::size_t spheres)
{
    const auto& colors = tiles.color_first;
    return !tiles.first.empty() && divides(tiles.first, tiles.count(), tiles.spheres.size()) &&
           are_indices(tiles.spheres, spheres) && std::ranges::is_sorted(colors) && colors.back() <= tiles.count();
}

bool are_pairs(const ContactNetwork& contacts, std::size_t spheres, const Model& model)
{
    const auto is_pair = [&](const IndexPair& pair) { return are_indices(std::array{pair.a, pair.b}, spheres); };
    return std::ranges::all_of(contacts.pairs, is_pair) &&
           divides(contacts.pairs_of_tile, contacts.tiles.count(), contacts.pairs.size()) &&
           are_indices(contacts.pair_of_sphere, contacts.pairs.size()) &&
           are_ranges(contacts.first_pair, contacts.pair_count, contacts.pair_of_sphere.size()) &&
           are_carried(contacts.pair_carried, contacts.pairs.size(), model);
}

bool is_wall_pair(
    const ContactNetwork& contacts, const WallPair& pair, std::size_t spheres, const std::vector<PlacedWall>& walls)
{
    if (!are_indices(std::array{pair.sphere}, spheres) || !are_indices(std::array{pair.wall}, walls.size()))
        return false;
    const std::size_t end = std::size_t{pair.first} + pair.patches;
    if (end > contacts.patches.size() || pair.carried > pair.patches) return false;
    const auto patches = std::span(contacts.patches).subspan(pair.first, pair.patches);
    return are_indices(patches, walls[static_cast<std::size_t>(pair.wall)].patch_count());
}

bool are_wall_pairs(const ContactNetwork& contacts, const State& state, const Model& model)
{
    const auto walls = place_walls(model, state);
    const auto is_pair = [&](const WallPair& pair) { return is_wall_pair(contacts, pair, state.count(), walls); };
    const std::size_t slots = contacts.patches.size();
    return std::ranges::all_of(contacts.wall_pairs, is_pair) &&
           divides(contacts.wall_pairs_of_tile, contacts.tiles.count(), contacts.wall_pairs.size()) &&
           are_ranges(contacts.first_wall_pair, contacts.wall_pair_count, contacts.wall_pairs.size()) &&
           divides(contacts.wall_slots_of_tile, contacts.tiles.count(), slots) &&
           are_long(slots, contacts.wall_carried_normal) && are_carried(contacts.wall_carried, slots, model);
}

} // namespace

void require_whole(const State& state, const ContactNetwork& contacts, const Model& model)
{
    const std::size_t n = state.count();
    const bool whole = are_spheres(state, model) && contacts.listed_box.size() <= n &&
                       (contacts.listed_pose.empty() || contacts.listed_pose.size() == model.walls.size()) &&
                       are_tiles(contacts.tiles, n) && are_pairs(contacts, n, model) &&
                       are_wall_pairs(contacts, state, model);
    if (!whole) throw ArchiveError("the saved state contradicts itself");
}

} // namespace talus
