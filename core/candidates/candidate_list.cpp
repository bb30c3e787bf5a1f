// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_list.hpp"

#include <algorithm>

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

/// Entries by sphere: those of sphere i are sorted[first[i]] to sorted[first[i] + count[i] − 1].
template <class Entry> struct BySphere {
    std::vector<std::uint32_t> first, count;
    std::vector<Entry> sorted;
};

/// Brings entries into the order of the tiles' spheres, and those of a sphere into that of their other half.
template <class Entry, class SphereOf, class OtherOf>
BySphere<Entry> sort_by_sphere(const std::vector<Entry>& entries, const Tiles& tiles, SphereOf sphere, OtherOf other)
{
    const std::size_t spheres = tiles.spheres.size();
    BySphere<Entry> result{
        std::vector<std::uint32_t>(spheres), std::vector<std::uint32_t>(spheres), std::vector<Entry>(entries.size())};
    for (const Entry& e : entries) ++result.count[sphere(e)];
    std::uint32_t next = 0;
    for (const auto i : tiles.spheres) {
        result.first[i] = next;
        next += result.count[i];
    }
    auto place = result.first;
    for (const Entry& e : entries) result.sorted[place[sphere(e)]++] = e;
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto begin = result.sorted.begin() + result.first[i];
        std::sort(begin, begin + result.count[i], [&](const Entry& p, const Entry& q) { return other(p) < other(q); });
    }
    return result;
}

/// The order in which a tile's pairs are swept: the first pair of every sphere, then the second of every sphere, and so
/// on. Two contacts in a row then seldom share a sphere, so the processor need not wait for one to be written before it
/// reads for the next (twice as fast as sphere by sphere); how many sweeps are needed does not depend on the order.
template <class Visit>
void for_each_pair_in_sweep_order(const Tiles& tiles, const BySphere<PairEntry>& pairs, std::size_t tile, Visit&& visit)
{
    bool more = true;
    for (std::uint32_t round = 0; more; ++round) {
        more = false;
        for (auto k = tiles.first[tile]; k < tiles.first[tile + 1]; ++k) {
            const auto i = tiles.spheres[k];
            if (round >= pairs.count[i]) continue;
            visit(pairs.sorted[pairs.first[i] + round]);
            more = true;
        }
    }
}

/// Lays down the new pair list by tile, in sweep order, with its carried impulses.
void lay_down_pairs(
    CandidateList& list, CarriedImpulses& carried, const std::vector<PairEntry>& entries, bool with_rolling)
{
    const auto by_sphere = sort_by_sphere(
        entries, list.tiles, [](const PairEntry& e) { return e.pair.a; }, [](const PairEntry& e) { return e.pair.b; });
    const auto old = std::move(carried);
    carried = CarriedImpulses(entries.size(), with_rolling);
    list.pairs.clear();
    list.pairs_of_tile.assign(1, 0);
    for (std::size_t t = 0; t < list.tiles.count(); ++t) {
        for_each_pair_in_sweep_order(list.tiles, by_sphere, t, [&](const PairEntry& e) {
            if (e.old != not_listed) carried.copy(list.pairs.size(), old, static_cast<std::size_t>(e.old), e.opposite);
            list.pairs.push_back(e.pair);
        });
        list.pairs_of_tile.push_back(static_cast<std::uint32_t>(list.pairs.size()));
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
void lay_down_walls(CandidateList& list, Carried& carried, const CandidateEntries& entries, bool with_rolling)
{
    const auto by_sphere = sort_by_sphere(
        entries.walls, list.tiles, [](const WallEntry& e) { return e.sphere; },
        [](const WallEntry& e) { return e.wall; });
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
    lay_down_pairs(list, carried.pairs, entries.pairs, model.physics.rolling);
    lay_down_walls(list, carried, entries, model.physics.rolling);
}

} // namespace talus
