// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_list.hpp"

#include <algorithm>
#include <numeric>

namespace talus
{
namespace
{

/// Pairs in the order in which a tile sweeps them: the first of every sphere, then the second of every sphere, and so
/// on, so that those in a row seldom share one. How many sweeps are needed does not depend on the order.
/// @param pairs in the order of their spheres @param visit is given a place in them
template <class Visit> void for_each_in_sweep_order(const std::vector<IndexPair>& pairs, Visit&& visit)
{
    std::vector<std::size_t> first; // of each sphere's pairs
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (k == 0 || pairs[k].a != pairs[k - 1].a) first.push_back(k);
    first.push_back(pairs.size());
    bool more = true;
    for (std::size_t round = 0; more; ++round) {
        more = false;
        for (std::size_t s = 0; s + 1 < first.size(); ++s) {
            if (first[s] + round >= first[s + 1]) continue;
            visit(first[s] + round);
            more = true;
        }
    }
}

/// Puts new pairs behind those of a tile.
/// @param found in the order of their spheres @param known_as places in `known`, in the order of their pairs
void append_pairs(Tile& tile, const std::vector<IndexPair>& found, const std::vector<std::uint32_t>& known_as,
    const LoosePairs& known, bool with_rolling)
{
    std::vector<std::int32_t> old(found.size(), not_listed);
    auto next = known_as.begin();
    for (std::size_t k = 0; k < found.size(); ++k) {
        while (next != known_as.end() && known.pairs[*next] < found[k]) ++next;
        if (next != known_as.end() && known.pairs[*next] == found[k]) old[k] = static_cast<std::int32_t>(*next);
    }
    tile.pairs.reserve(tile.pairs.size() + found.size());
    tile.carried.resize(tile.pairs.size() + found.size(), with_rolling);
    for_each_in_sweep_order(found, [&](std::size_t k) {
        if (old[k] != not_listed) tile.carried.copy(tile.pairs.size(), known.carried, static_cast<std::size_t>(old[k]));
        tile.pairs.push_back(found[k]);
    });
}

/// The tile of each sphere that comes first in these pairs.
std::vector<std::int32_t> owners(
    const std::vector<IndexPair>& pairs, const CandidateList& list, const std::vector<std::uint64_t>& cells)
{
    std::vector<std::int32_t> owner(pairs.size());
#pragma omp parallel for schedule(static) if (pairs.size() > 10000)
    for (std::size_t k = 0; k < pairs.size(); ++k)
        owner[k] = list.tiles.of_cell(cells[static_cast<std::size_t>(pairs[k].a)]);
    return owner;
}

void lay_down_pairs(CandidateList& list, const std::vector<IndexPair>& found, const LoosePairs& known,
    const std::vector<std::uint64_t>& cells, bool with_rolling)
{
    const SortedByTile found_of(owners(found, list, cells), list.tiles.count());
    const SortedByTile known_of(owners(known.pairs, list, cells), list.tiles.count());
#pragma omp parallel for schedule(dynamic) if (list.tiles.count() > 16)
    for (std::size_t t = 0; t < list.tiles.count(); ++t) {
        if (found_of.count(t) == 0) continue;
        std::vector<IndexPair> mine;
        mine.reserve(found_of.count(t));
        for (auto k = found_of.begin(t); k != found_of.end(t); ++k) mine.push_back(found[*k]);
        std::sort(mine.begin(), mine.end());
        std::vector<std::uint32_t> known_as(known_of.begin(t), known_of.end(t));
        std::ranges::sort(known_as, {}, [&](std::uint32_t k) { return known.pairs[k]; });
        append_pairs(list.tiles.tiles[t], mine, known_as, known, with_rolling);
    }
}

/// Puts what the contacts of an old wall pair carried into the slots of its successor.
void carry_wall_pair(WallPair& pair, Carried& carried, const WallPair& old_pair, const CarriedImpulses& old,
    const std::vector<Vec3>& old_normal)
{
    pair.carried = std::min(old_pair.carried, pair.patches);
    for (std::uint32_t k = 0; k < pair.carried; ++k) {
        carried.walls.copy(pair.first + k, old, old_pair.first + k);
        carried.wall_normal[pair.first + k] = old_normal[old_pair.first + k];
    }
}

/// Lays down the wall list by tile, sphere and wall, with its carried impulses.
void lay_down_walls(CandidateList& list, Carried& carried, const WallEntries& entries,
    const std::vector<std::uint64_t>& cells, bool with_rolling)
{
    std::vector<std::int32_t> tile;
    tile.reserve(entries.walls.size());
    for (const WallEntry& e : entries.walls)
        tile.push_back(list.tiles.of_cell(cells[static_cast<std::size_t>(e.sphere)]));
    const SortedByTile by_tile(tile, list.tiles.count());
    list.wall_pairs_of_tile = by_tile.first();
    auto order = by_tile.places();
    for (std::size_t t = 0; t < list.tiles.count(); ++t)
        std::sort(order.begin() + by_tile.first()[t], order.begin() + by_tile.first()[t + 1],
            [&](std::uint32_t j, std::uint32_t k) {
                const WallEntry &p = entries.walls[j], &q = entries.walls[k];
                return p.sphere != q.sphere ? p.sphere < q.sphere : p.wall < q.wall;
            });

    const auto old_pairs = std::move(list.wall_pairs);
    const auto old = std::move(carried.walls);
    const auto old_normal = std::move(carried.wall_normal);
    list.wall_pairs.clear();
    list.patches.clear();
    for (const std::uint32_t k : order) {
        const WallEntry& e = entries.walls[k];
        const auto first = entries.patches.begin() + e.first;
        list.wall_pairs.push_back({e.sphere, e.wall, static_cast<std::uint32_t>(list.patches.size()), e.patches, 0});
        list.patches.insert(list.patches.end(), first, first + e.patches);
    }
    carried.walls = CarriedImpulses(list.patches.size(), with_rolling);
    carried.wall_normal.assign(list.patches.size(), Vec3::UnitZ());
    for (std::size_t k = 0; k < order.size(); ++k)
        if (const auto from = entries.walls[order[k]].old; from != not_listed)
            carry_wall_pair(list.wall_pairs[k], carried, old_pairs[static_cast<std::size_t>(from)], old, old_normal);
}

} // namespace

void CandidateList::persist(Archive& archive)
{
    archive(listed_box, listed_pose, listed_around, tile_edge, tiles, wall_pairs, wall_pairs_of_tile, patches);
}

LoosePairs take_pairs(Tiles& tiles, const std::vector<std::uint8_t>& is_one, bool with_rolling)
{
    std::vector<LoosePairs> of_tile(tiles.count());
#pragma omp parallel for schedule(dynamic) if (tiles.count() > 16)
    for (std::size_t t = 0; t < tiles.count(); ++t) {
        Tile& tile = tiles.tiles[t];
        std::size_t kept = 0;
        for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot) {
            const IndexPair pair = tile.pairs[slot];
            if (is_one[static_cast<std::size_t>(pair.a)] | is_one[static_cast<std::size_t>(pair.b)]) {
                of_tile[t].carried.resize(of_tile[t].pairs.size() + 1, with_rolling);
                of_tile[t].carried.copy(of_tile[t].pairs.size(), tile.carried, slot);
                of_tile[t].pairs.push_back(pair);
                continue;
            }
            if (kept != slot) {
                tile.pairs[kept] = pair;
                tile.carried.copy(kept, tile.carried, slot);
            }
            ++kept;
        }
        tile.pairs.resize(kept);
        tile.carried.resize(kept, with_rolling);
    }
    LoosePairs taken;
    for (const LoosePairs& from : of_tile) {
        taken.pairs.insert(taken.pairs.end(), from.pairs.begin(), from.pairs.end());
        taken.carried.append(from.carried);
    }
    return taken;
}

void lay_down(CandidateList& list, Carried& carried, const std::vector<IndexPair>& found, const LoosePairs& known,
    const WallEntries& walls, const Model& model)
{
    const TileGrid grid = list.grid(model);
    const auto spheres = list.listed_box.size();
    std::vector<std::uint64_t> cells(spheres);
#pragma omp parallel for schedule(static) if (spheres > 1000)
    for (std::size_t i = 0; i < spheres; ++i) cells[i] = grid.cell(list.listed_box[i].center());

    std::vector<std::uint64_t> needed;
    needed.reserve(found.size() + walls.walls.size());
    for (const IndexPair& pair : found) needed.push_back(cells[static_cast<std::size_t>(pair.a)]);
    for (const WallEntry& e : walls.walls) needed.push_back(cells[static_cast<std::size_t>(e.sphere)]);
    list.tiles.open(std::move(needed));
    lay_down_pairs(list, found, known, cells, model.physics.rolling);
    lay_down_walls(list, carried, walls, cells, model.physics.rolling);
}

} // namespace talus
