// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_list.hpp"

namespace talus
{
namespace
{

void remove_pairs(Tile& tile, const std::vector<std::int32_t>& new_index)
{
    std::size_t kept = 0;
    for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot) {
        const IndexPair pair{new_index[static_cast<std::size_t>(tile.pairs[slot].a)],
            new_index[static_cast<std::size_t>(tile.pairs[slot].b)]};
        if (pair.a < 0 || pair.b < 0) continue;
        tile.pairs[kept] = pair;
        if (kept != slot) tile.carried.copy(kept, tile.carried, slot);
        ++kept;
    }
    tile.pairs.resize(kept);
    tile.carried.resize(kept, !tile.carried.rolling_impulse.empty());
}

void remove_wall_pairs(CandidateList& list, Carried& carried, const std::vector<std::int32_t>& new_index)
{
    std::uint32_t kept = 0, slots = 0, begin = 0;
    for (std::size_t t = 0; t < list.tiles.count(); ++t) {
        const std::uint32_t end = list.wall_pairs_of_tile[t + 1];
        for (std::uint32_t from = begin; from < end; ++from) {
            WallPair pair = list.wall_pairs[from];
            pair.sphere = new_index[static_cast<std::size_t>(pair.sphere)];
            if (pair.sphere < 0) continue;
            for (std::uint32_t k = 0; k < pair.patches; ++k) {
                list.patches[slots + k] = list.patches[pair.first + k];
                carried.walls.copy(slots + k, carried.walls, pair.first + k);
                carried.wall_normal[slots + k] = carried.wall_normal[pair.first + k];
            }
            pair.first = slots;
            slots += pair.patches;
            list.wall_pairs[kept++] = pair;
        }
        list.wall_pairs_of_tile[t + 1] = kept;
        begin = end;
    }
    list.wall_pairs.resize(kept);
    list.patches.resize(slots);
    carried.walls.resize(slots, !carried.walls.rolling_impulse.empty());
    carried.wall_normal.resize(slots);
}

} // namespace

void remove_candidates(CandidateList& list, Carried& carried, const std::vector<std::int32_t>& new_index)
{
#pragma omp parallel for schedule(dynamic) if (list.tiles.count() > 16)
    for (std::size_t t = 0; t < list.tiles.count(); ++t) remove_pairs(list.tiles.tiles[t], new_index);
    remove_wall_pairs(list, carried, new_index);
    std::size_t boxes = 0;
    for (std::size_t i = 0; i < list.listed_box.size(); ++i)
        if (new_index[i] >= 0) list.listed_box[boxes++] = list.listed_box[i];
    list.listed_box.resize(boxes);
}

} // namespace talus
