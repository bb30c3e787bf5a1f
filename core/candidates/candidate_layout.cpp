// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_layout.hpp"

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

/// Which pairs come first in each sphere: first_pair and pair_count, in tile order, and where each tile's pairs begin.
void count_pairs(ContactNetwork& network, const std::vector<PairEntry>& entries, std::size_t spheres)
{
    network.pair_count.assign(spheres, 0);
    network.first_pair.assign(spheres, 0);
    for (const auto& e : entries) ++network.pair_count[e.pair.a];
    network.pairs_of_tile.assign(1, 0);
    std::uint32_t next = 0;
    for (std::size_t t = 0; t < network.tiles.count(); ++t) {
        for (auto k = network.tiles.first[t]; k < network.tiles.first[t + 1]; ++k) {
            const auto i = network.tiles.spheres[k];
            network.first_pair[i] = next;
            next += network.pair_count[i];
        }
        network.pairs_of_tile.push_back(next);
    }
}

/// The order in which a tile's pairs are swept: the first pair of every sphere, then the second of every sphere, and so
/// on. Two contacts in a row then seldom share a sphere, so the processor need not wait for one to be written before it
/// reads for the next (twice as fast as sphere by sphere); how many sweeps are needed does not depend on the order.
template <class Visit> void for_each_pair_in_sweep_order(const ContactNetwork& network, std::size_t tile, Visit&& visit)
{
    bool more = true;
    for (std::uint32_t round = 0; more; ++round) {
        more = false;
        for (auto k = network.tiles.first[tile]; k < network.tiles.first[tile + 1]; ++k) {
            const auto i = network.tiles.spheres[k];
            if (round >= network.pair_count[i]) continue;
            visit(network.first_pair[i] + round);
            more = true;
        }
    }
}

/// Lays down the new pair list by tile, in sweep order, with its carried impulses.
void lay_down_pairs(
    ContactNetwork& network, const std::vector<PairEntry>& entries, std::size_t spheres, bool with_rolling)
{
    count_pairs(network, entries, spheres);
    std::vector<PairEntry> sorted(entries.size());
    auto place = network.first_pair;
    for (const auto& e : entries) sorted[place[e.pair.a]++] = e;
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto begin = sorted.begin() + network.first_pair[i];
        std::sort(
            begin, begin + network.pair_count[i], [](const auto& p, const auto& q) { return p.pair.b < q.pair.b; });
    }

    const auto old = std::move(network.pair_carried);
    network.pair_carried = CarriedImpulses(sorted.size(), with_rolling);
    network.pairs.clear();
    network.pair_of_sphere.resize(sorted.size());
    for (std::size_t t = 0; t < network.tiles.count(); ++t)
        for_each_pair_in_sweep_order(network, t, [&](std::uint32_t k) {
            const auto slot = network.pairs.size();
            const auto& source = sorted[k].source;
            network.pairs.push_back(sorted[k].pair);
            network.pair_of_sphere[k] = static_cast<std::uint32_t>(slot);
            if (source.old != EntrySource::none)
                network.pair_carried.copy(slot, old, static_cast<std::size_t>(source.old), source.opposite);
        });
}

/// Puts what the contacts of an old wall pair carried into the slots of its successor.
void carry_wall_pair(ContactNetwork& network, WallPair& pair, const WallPair& old_pair, const CarriedImpulses& old,
    const std::vector<Vec3>& old_normal)
{
    pair.carried = std::min(old_pair.carried, pair.patches);
    for (std::uint32_t k = 0; k < pair.carried; ++k) {
        network.wall_carried.copy(pair.first + k, old, old_pair.first + k);
        network.wall_carried_normal[pair.first + k] = old_normal[old_pair.first + k];
    }
}

/// Lays down the wall list by tile, sphere and wall, with its carried impulses.
void lay_down_walls(ContactNetwork& network, const CandidateEntries& entries, std::size_t spheres, bool with_rolling)
{
    network.wall_pair_count.assign(spheres, 0);
    network.first_wall_pair.assign(spheres, 0);
    for (const auto& e : entries.walls) ++network.wall_pair_count[e.sphere];
    std::uint32_t next = 0;
    for (const auto i : network.tiles.spheres) {
        network.first_wall_pair[i] = next;
        next += network.wall_pair_count[i];
    }
    std::vector<WallEntry> sorted(entries.walls.size());
    auto place = network.first_wall_pair;
    for (const auto& e : entries.walls) sorted[place[e.sphere]++] = e;
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto begin = sorted.begin() + network.first_wall_pair[i];
        std::sort(
            begin, begin + network.wall_pair_count[i], [](const auto& p, const auto& q) { return p.wall < q.wall; });
    }

    const auto old_pairs = std::move(network.wall_pairs);
    const auto old = std::move(network.wall_carried);
    const auto old_normal = std::move(network.wall_carried_normal);
    network.wall_pairs.clear();
    network.patches.clear();
    for (const auto& e : sorted) {
        network.wall_pairs.push_back(
            {e.sphere, e.wall, static_cast<std::uint32_t>(network.patches.size()), e.patches, 0});
        network.patches.insert(
            network.patches.end(), entries.patches.begin() + e.first, entries.patches.begin() + e.first + e.patches);
    }
    network.wall_carried = CarriedImpulses(network.patches.size(), with_rolling);
    network.wall_carried_normal.assign(network.patches.size(), Vec3::UnitZ());
    for (std::size_t k = 0; k < sorted.size(); ++k)
        if (sorted[k].old != EntrySource::none)
            carry_wall_pair(network, network.wall_pairs[k], old_pairs[sorted[k].old], old, old_normal);

    network.wall_pairs_of_tile.assign(1, 0);
    network.wall_slots_of_tile.assign(1, 0);
    for (std::size_t t = 0; t < network.tiles.count(); ++t) {
        const auto last = network.tiles.spheres[network.tiles.first[t + 1] - 1];
        const auto end = network.first_wall_pair[last] + network.wall_pair_count[last];
        network.wall_pairs_of_tile.push_back(end);
        network.wall_slots_of_tile.push_back(end < network.wall_pairs.size()
                                                 ? network.wall_pairs[end].first
                                                 : static_cast<std::uint32_t>(network.patches.size()));
    }
}

} // namespace

void lay_down(ContactNetwork& network, const CandidateEntries& entries, const State& state, const Model& model)
{
    network.tiles = make_tiles(state.position, tile_edge(entries.pairs, state, model), model.periodicity, model.corner);
    lay_down_pairs(network, entries.pairs, state.count(), model.physics.rolling);
    lay_down_walls(network, entries, state.count(), model.physics.rolling);
    network.resize_contacts(model.physics);
}

} // namespace talus
