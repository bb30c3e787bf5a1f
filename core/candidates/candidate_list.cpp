// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_list.hpp"

#include <algorithm>
#include <numeric>

namespace talus
{
namespace
{

/// Least tile edge with which no two tiles of a colour share a sphere, and at least four diameters.
double tile_edge(const std::vector<PairEntry>& pairs, const State& state, const Model& model)
{
    double farthest = 0.0;
    for (const auto& e : pairs) {
        const Vec3 apart = model.periodicity.nearest_image(state.position[e.pair.a] - state.position[e.pair.b]);
        farthest = std::max(farthest, apart.lpNorm<Eigen::Infinity>());
    }
    return std::max(4.0 * model.max_diameter, 2.001 * farthest);
}

/// The pairs whose first sphere is i are entries first[i] to first[i + 1] − 1.
std::vector<std::uint32_t> first_of_spheres(const std::vector<PairEntry>& entries, std::size_t spheres)
{
    std::vector<std::uint32_t> first(spheres + 1, 0);
    for (const PairEntry& e : entries) ++first[static_cast<std::size_t>(e.pair.a) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

/// The order in which a tile's pairs are swept: the first pair of every sphere, then the second of every sphere, and so
/// on. Two contacts in a row then seldom share a sphere, so the processor need not wait for one to be written before it
/// reads for the next (twice as fast as sphere by sphere); how many sweeps are needed does not depend on the order.
template <class Visit>
void for_each_pair_in_sweep_order(
    const Tiles& tiles, const std::vector<std::uint32_t>& first, std::size_t tile, Visit&& visit)
{
    bool more = true;
    for (std::uint32_t round = 0; more; ++round) {
        more = false;
        for (auto k = tiles.first[tile]; k < tiles.first[tile + 1]; ++k) {
            const auto i = static_cast<std::size_t>(tiles.spheres[k]);
            if (first[i] + round >= first[i + 1]) continue;
            visit(first[i] + round);
            more = true;
        }
    }
}

/// Lays down the new pair list by tile, in sweep order, with its carried impulses.
void lay_down_pairs(CandidateList& list, CarriedImpulses& carried, const std::vector<PairEntry>& entries,
    std::size_t spheres, bool with_rolling)
{
    const auto first = first_of_spheres(entries, spheres);
    const auto tiles = static_cast<std::int64_t>(list.tiles.count());
    list.pairs_of_tile.assign(1, 0);
    for (std::size_t t = 0; t < list.tiles.count(); ++t) {
        std::uint32_t count = 0;
        for (auto k = list.tiles.first[t]; k < list.tiles.first[t + 1]; ++k) {
            const auto i = static_cast<std::size_t>(list.tiles.spheres[k]);
            count += first[i + 1] - first[i];
        }
        list.pairs_of_tile.push_back(list.pairs_of_tile.back() + count);
    }

    const auto old = std::move(carried);
    carried = CarriedImpulses(entries.size(), with_rolling);
    list.pairs.resize(entries.size());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        std::size_t slot = list.pairs_of_tile[tile];
        for_each_pair_in_sweep_order(list.tiles, first, tile, [&](std::uint32_t entry) {
            const PairEntry& e = entries[entry];
            list.pairs[slot] = e.pair;
            if (e.old != not_listed) carried.copy(slot, old, static_cast<std::size_t>(e.old), e.opposite);
            ++slot;
        });
    }
}

/// Entries of walls by sphere: those of sphere i are sorted[first[i]] to sorted[first[i] + count[i] − 1].
struct WallsBySphere {
    std::vector<std::uint32_t> first, count;
    std::vector<WallEntry> sorted;
};

/// Brings them into the order of the tiles' spheres, and those of a sphere into that of the walls.
WallsBySphere sort_by_sphere(const std::vector<WallEntry>& entries, const Tiles& tiles)
{
    const std::size_t spheres = tiles.spheres.size();
    WallsBySphere result{std::vector<std::uint32_t>(spheres), std::vector<std::uint32_t>(spheres),
        std::vector<WallEntry>(entries.size())};
    for (const WallEntry& e : entries) ++result.count[e.sphere];
    std::uint32_t next = 0;
    for (const auto i : tiles.spheres) {
        result.first[i] = next;
        next += result.count[i];
    }
    auto place = result.first;
    for (const WallEntry& e : entries) result.sorted[place[e.sphere]++] = e;
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto begin = result.sorted.begin() + result.first[i];
        std::sort(begin, begin + result.count[i], [](const auto& p, const auto& q) { return p.wall < q.wall; });
    }
    return result;
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
void lay_down_walls(CandidateList& list, Carried& carried, const CandidateEntries& entries, bool with_rolling)
{
    const auto by_sphere = sort_by_sphere(entries.walls, list.tiles);
    const auto old_pairs = std::move(list.wall_pairs);
    const auto old = std::move(carried.walls);
    const auto old_normal = std::move(carried.wall_normal);
    list.wall_pairs.clear();
    list.patches.clear();
    for (const auto& e : by_sphere.sorted) {
        const auto first = entries.patches.begin() + e.first;
        list.wall_pairs.push_back({e.sphere, e.wall, static_cast<std::uint32_t>(list.patches.size()), e.patches, 0});
        list.patches.insert(list.patches.end(), first, first + e.patches);
    }
    carried.walls = CarriedImpulses(list.patches.size(), with_rolling);
    carried.wall_normal.assign(list.patches.size(), Vec3::UnitZ());
    for (std::size_t k = 0; k < by_sphere.sorted.size(); ++k)
        if (const auto from = by_sphere.sorted[k].old; from != not_listed)
            carry_wall_pair(list.wall_pairs[k], carried, old_pairs[from], old, old_normal);

    list.wall_pairs_of_tile.assign(1, 0);
    list.wall_slots_of_tile.assign(1, 0);
    for (std::size_t t = 0; t < list.tiles.count(); ++t) {
        const auto last = list.tiles.spheres[list.tiles.first[t + 1] - 1];
        const auto end = by_sphere.first[last] + by_sphere.count[last];
        list.wall_pairs_of_tile.push_back(end);
        list.wall_slots_of_tile.push_back(end < list.wall_pairs.size()
                                              ? list.wall_pairs[end].first
                                              : static_cast<std::uint32_t>(list.patches.size()));
    }
}

} // namespace

void CandidateList::persist(Archive& archive)
{
    archive(listed_box, listed_pose, listed_around, tiles, pairs, pairs_of_tile, wall_pairs, wall_pairs_of_tile,
        wall_slots_of_tile, patches);
}

void lay_down(
    CandidateList& list, Carried& carried, const CandidateEntries& entries, const State& state, const Model& model)
{
    list.tiles =
        make_tiles(state.position, tile_edge(entries.pairs, state, model), model.periodicity, model.contents.min);
    lay_down_pairs(list, carried.pairs, entries.pairs, state.count(), model.physics.rolling);
    lay_down_walls(list, carried, entries, model.physics.rolling);
}

} // namespace talus
