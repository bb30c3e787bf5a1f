// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_list.hpp"

namespace talus
{
namespace
{

/// Keeps the entries of each tile that `keep` lets pass, in their order, and follows with the first ones of the tiles.
template <class Keep> std::uint32_t keep_by_tile(std::vector<std::uint32_t>& first_of_tile, Keep&& keep)
{
    std::uint32_t kept = 0, begin = first_of_tile.front();
    for (std::size_t t = 0; t + 1 < first_of_tile.size(); ++t) {
        const std::uint32_t end = first_of_tile[t + 1];
        for (std::uint32_t k = begin; k < end; ++k)
            if (keep(k, kept)) ++kept;
        first_of_tile[t + 1] = kept;
        begin = end;
    }
    return kept;
}

void remove_pairs(CandidateList& list, CarriedImpulses& carried, const std::vector<std::int32_t>& new_index)
{
    const auto kept = keep_by_tile(list.pairs_of_tile, [&](std::uint32_t from, std::uint32_t to) {
        const IndexPair pair{new_index[list.pairs[from].a], new_index[list.pairs[from].b]};
        if (pair.a < 0 || pair.b < 0) return false;
        list.pairs[to] = pair;
        if (to != from) carried.copy(to, carried, from);
        return true;
    });
    list.pairs.resize(kept);
    carried.shrink(kept);
}

void remove_wall_pairs(CandidateList& list, Carried& carried, const std::vector<std::int32_t>& new_index)
{
    std::uint32_t slots = 0;
    std::vector<std::uint32_t> slots_before = {0}; // of as many pairs
    const auto kept = keep_by_tile(list.wall_pairs_of_tile, [&](std::uint32_t from, std::uint32_t to) {
        WallPair pair = list.wall_pairs[from];
        pair.sphere = new_index[pair.sphere];
        if (pair.sphere < 0) return false;
        for (std::uint32_t k = 0; k < pair.patches; ++k) {
            list.patches[slots + k] = list.patches[pair.first + k];
            carried.walls.copy(slots + k, carried.walls, pair.first + k);
            carried.wall_normal[slots + k] = carried.wall_normal[pair.first + k];
        }
        pair.first = slots;
        list.wall_pairs[to] = pair;
        slots += pair.patches;
        slots_before.push_back(slots);
        return true;
    });
    list.wall_pairs.resize(kept);
    list.patches.resize(slots);
    carried.walls.shrink(slots);
    carried.wall_normal.resize(slots);
    for (std::size_t t = 0; t < list.wall_slots_of_tile.size(); ++t)
        list.wall_slots_of_tile[t] = slots_before[list.wall_pairs_of_tile[t]];
}

} // namespace

void remove_candidates(CandidateList& list, Carried& carried, const std::vector<std::int32_t>& new_index)
{
    remove_pairs(list, carried.pairs, new_index);
    remove_wall_pairs(list, carried, new_index);
    const auto spheres = keep_by_tile(list.tiles.first, [&](std::uint32_t from, std::uint32_t to) {
        const std::int32_t sphere = new_index[list.tiles.spheres[from]];
        if (sphere >= 0) list.tiles.spheres[to] = sphere;
        return sphere >= 0;
    });
    list.tiles.spheres.resize(spheres);
    std::size_t boxes = 0;
    for (std::size_t i = 0; i < list.listed_box.size(); ++i)
        if (new_index[i] >= 0) list.listed_box[boxes++] = list.listed_box[i];
    list.listed_box.resize(boxes);
}

} // namespace talus
