// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidate_search.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr double skin = 0.08;         ///< growth of a listed box on each side, in smallest diameters …
constexpr double skin_per_draw = 0.2; ///< … and this share of what it is drawn out: fast grains stray more
constexpr double horizon_steps = 20;  ///< steps along its way for which a listed box is drawn out …
constexpr double longest_draw = 1.0;  ///< … but by this many smallest diameters at most
constexpr double worn_share = 0.25; ///< a sphere that has used up so much of its skin is searched for along with others
constexpr double wall_skin = 0.2;   ///< how far a wall may move before it is searched for anew, in smallest diameters
constexpr double few = 0.3;         ///< share of the spheres up to which they are searched for alone

/// Room around the centre of sphere i that its surface takes, with half the reach of its contacts.
double needed_radius(const State& state, const Model& model, std::size_t i)
{
    return state.radius(i) + 0.5 * open_contact_reach * model.min_diameter;
}

/// The room that sphere i takes, and would take after the closing horizon, with the reach of its contacts.
Box needed_box(const State& state, const Model& model, std::size_t i)
{
    const Vec3& x = state.position[i];
    const Vec3 move = closing_horizon * model.time_step * (state.motion[i].velocity + model.time_step * model.gravity);
    return Box{x, x}.extend(Vec3(x + move)).grown(needed_radius(state, model, i));
}

Box new_listed_box(const State& state, const Model& model, std::size_t i)
{
    const double t = horizon_steps * model.time_step;
    Vec3 draw = t * state.motion[i].velocity + 0.5 * t * t * model.gravity;
    const double longest = longest_draw * model.min_diameter;
    if (draw.norm() > longest) draw *= longest / draw.norm();
    const Box now = needed_box(state, model, i);
    return Box(now)
        .extend(Box{now.min + draw, now.max + draw})
        .grown(skin * model.min_diameter + skin_per_draw * draw.norm());
}

/// A pair or wall pair of the new list, and where its carried impulses come from.
struct Source {
    static constexpr std::int32_t none = -1;
    std::int32_t old = none; ///< index in the old list
    bool opposite = false;   ///< the two spheres have changed places
};
struct PairEntry {
    IndexPair pair;
    Source source;
};
struct WallEntry {
    std::int32_t sphere, wall;
    std::uint32_t first, patches; ///< in the entries' own patch array
    std::int32_t old = Source::none;
};
struct Entries {
    std::vector<PairEntry> pairs;
    std::vector<WallEntry> walls;
    std::vector<std::int32_t> patches;
};

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
            if (source.old != Source::none)
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
void lay_down_walls(ContactNetwork& network, Entries& entries, std::size_t spheres, bool with_rolling)
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
        if (sorted[k].old != Source::none)
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

/// Sorts spheres and entries into tiles.
void lay_down(ContactNetwork& network, Entries& entries, const State& state, const Model& model)
{
    network.tiles = make_tiles(state.position, tile_edge(entries.pairs, state, model), model.periodicity);
    lay_down_pairs(network, entries.pairs, state.count(), model.physics.rolling);
    lay_down_walls(network, entries, state.count(), model.physics.rolling);
    network.resize_contacts(model.physics);
}

/// The spheres whose listed box no longer serves; when there are any, those whose skin is nearly used up too.
std::vector<std::int32_t> spheres_to_search(const ContactNetwork& network, const State& state, const Model& model)
{
    const auto count = static_cast<std::int64_t>(state.count());
    std::vector<std::uint8_t> wear(state.count(), 0);
    bool any_left = false;
#pragma omp parallel for schedule(static) reduction(|| : any_left) if (count > 1000)
    for (std::int64_t i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3 shift = model.periodicity.shift_towards(state.position[k], network.listed_box[k].center());
        const Box needed = needed_box(state, model, k).shifted(shift);
        const bool left = !network.listed_box[k].contains(needed);
        const bool worn = !network.listed_box[k].contains(needed.grown((1.0 - worn_share) * skin * model.min_diameter));
        wear[k] = left || worn;
        any_left = any_left || left;
    }
    std::vector<std::int32_t> result;
    if (any_left)
        for (std::int64_t i = 0; i < count; ++i)
            if (wear[static_cast<std::size_t>(i)]) result.push_back(static_cast<std::int32_t>(i));
    return result;
}

/// Where the old list has this pair, if it does.
std::int32_t find_old_pair(const ContactNetwork& network, const IndexPair& pair)
{
    if (static_cast<std::size_t>(pair.a) >= network.first_pair.size()) return Source::none;
    const auto begin = network.first_pair[pair.a];
    for (auto k = begin; k < begin + network.pair_count[pair.a]; ++k)
        if (network.pairs[network.pair_of_sphere[k]].b == pair.b)
            return static_cast<std::int32_t>(network.pair_of_sphere[k]);
    return Source::none;
}

std::int32_t find_old_wall_pair(const ContactNetwork& network, std::int32_t sphere, std::int32_t wall)
{
    if (static_cast<std::size_t>(sphere) >= network.first_wall_pair.size()) return Source::none;
    const auto begin = network.first_wall_pair[sphere];
    for (auto k = begin; k < begin + network.wall_pair_count[sphere]; ++k)
        if (network.wall_pairs[k].wall == wall) return static_cast<std::int32_t>(k);
    return Source::none;
}

/// Whether two spheres can come within reach of each other while each stays inside its listed box.
bool can_touch(const ContactNetwork& network, const State& state, const Model& model, const IndexPair& pair)
{
    const double ra = needed_radius(state, model, static_cast<std::size_t>(pair.a));
    const double rb = needed_radius(state, model, static_cast<std::size_t>(pair.b));
    const Box a = network.listed_box[pair.a].grown(-ra);
    const Box& box_b = network.listed_box[pair.b];
    const Box b = box_b.grown(-rb).shifted(model.periodicity.shift_towards(box_b.center(), a.center()));
    const Vec3 apart = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0);
    return apart.squaredNorm() <= (ra + rb) * (ra + rb);
}

void search_spheres(Entries& entries, const ContactNetwork& network, const State& state, const Model& model,
    const std::vector<std::int32_t>& movers)
{
    const bool alone = static_cast<double>(movers.size()) < few * static_cast<double>(network.listed_box.size());
    const auto found = alone ? find_box_pairs(network.listed_box, movers, model.periodicity)
                             : find_box_pairs(network.listed_box, model.periodicity);
    for (const auto& pair : found)
        if (can_touch(network, state, model, pair))
            entries.pairs.push_back({pair, {find_old_pair(network, pair), false}});
    if (!alone) return;

    std::vector<std::uint8_t> moves(network.listed_box.size(), 0);
    for (const auto i : movers) moves[i] = 1;
    for (std::size_t k = 0; k < network.pairs.size(); ++k)
        if (!moves[network.pairs[k].a] && !moves[network.pairs[k].b])
            entries.pairs.push_back({network.pairs[k], {static_cast<std::int32_t>(k), false}});
}

/// The walls that have moved so far since they were listed, or will in this step, that their lists may miss a sphere.
std::vector<std::uint8_t> walls_to_search(
    const ContactNetwork& network, const Model& model, const std::vector<PlacedWall>& walls)
{
    std::vector<std::uint8_t> stale(walls.size(), 0);
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (!walls[w].moves()) continue;
        if (!network.listed_pose.empty()) {
            const double way = walls[w].way_since(network.listed_pose[w], network.listed_around);
            const double ahead = closing_horizon * model.time_step * walls[w].fastest(network.listed_around);
            if (way + ahead <= wall_skin * model.min_diameter) continue;
        }
        stale[w] = 1;
    }
    return stale;
}

/// Who lies near which wall, written into the entries sphere by sphere.
class WallSearch
{
public:
    WallSearch(
        Entries& entries, const ContactNetwork& network, const Model& model, const std::vector<PlacedWall>& walls)
        : entries_(entries), network_(network), walls_(walls)
    {
        // A wall does not come half of the way, as another sphere does.
        const double reach = 0.5 * open_contact_reach * model.min_diameter;
        for (const auto& wall : walls) {
            // One skin that it may have moved already, where a sphere is searched for alone, and one for the future.
            const double ahead = closing_horizon * model.time_step * wall.fastest(network.listed_around);
            margin_.push_back(wall.moves() ? reach + 2.0 * wall_skin * model.min_diameter + ahead : reach);
        }
    }

    void search(std::int32_t sphere, std::size_t wall)
    {
        const auto first = static_cast<std::uint32_t>(entries_.patches.size());
        walls_[wall].patches_near(network_.listed_box[sphere].grown(margin_[wall]), entries_.patches);
        const auto patches = static_cast<std::uint32_t>(entries_.patches.size()) - first;
        const auto w = static_cast<std::int32_t>(wall);
        if (patches > 0) entries_.walls.push_back({sphere, w, first, patches, find_old_wall_pair(network_, sphere, w)});
    }

    void keep(std::size_t old_pair)
    {
        const auto& old = network_.wall_pairs[old_pair];
        const auto first = static_cast<std::uint32_t>(entries_.patches.size());
        for (std::uint32_t p = 0; p < old.patches; ++p) entries_.patches.push_back(network_.patches[old.first + p]);
        entries_.walls.push_back({old.sphere, old.wall, first, old.patches, static_cast<std::int32_t>(old_pair)});
    }

private:
    Entries& entries_;
    const ContactNetwork& network_;
    const std::vector<PlacedWall>& walls_;
    std::vector<double> margin_; ///< by wall [m]
};

void search_walls(Entries& entries, const ContactNetwork& network, const Model& model,
    const std::vector<PlacedWall>& walls, const std::vector<std::int32_t>& movers,
    const std::vector<std::uint8_t>& stale)
{
    const auto spheres = static_cast<std::int32_t>(network.listed_box.size());
    std::vector<std::uint8_t> moves(network.listed_box.size(), 0);
    for (const auto i : movers) moves[i] = 1;
    WallSearch near(entries, network, model, walls);
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (stale[w])
            for (std::int32_t i = 0; i < spheres; ++i) near.search(i, w);
        else
            for (const auto i : movers) near.search(i, w);
    }
    for (std::size_t k = 0; k < network.wall_pairs.size(); ++k)
        if (!moves[network.wall_pairs[k].sphere] && !stale[network.wall_pairs[k].wall]) near.keep(k);
}

} // namespace

std::size_t update_candidates(
    ContactNetwork& network, const State& state, const Model& model, const std::vector<PlacedWall>& walls)
{
    network.listed_box.resize(state.count());
    const auto movers = spheres_to_search(network, state, model);
    const auto stale = walls_to_search(network, model, walls);
    const bool any_stale = std::find(stale.begin(), stale.end(), 1) != stale.end();
    if (movers.empty() && !any_stale) return 0;
    for (const auto i : movers) network.listed_box[i] = new_listed_box(state, model, i);
    network.listed_around = Box{};
    for (const Box& box : network.listed_box) network.listed_around.extend(box);

    Entries entries;
    search_spheres(entries, network, state, model, movers);
    search_walls(entries, network, model, walls, movers, stale);
    network.listed_pose.resize(walls.size());
    for (std::size_t w = 0; w < walls.size(); ++w)
        if (stale[w]) network.listed_pose[w] = walls[w].pose();
    lay_down(network, entries, state, model);
    return movers.size();
}

void renumber_candidates(
    ContactNetwork& network, const State& state, const Model& model, const std::vector<std::int32_t>& new_index)
{
    std::vector<Box> listed_box(state.count());
    for (std::size_t i = 0; i < network.listed_box.size(); ++i)
        if (new_index[i] >= 0) listed_box[new_index[i]] = network.listed_box[i];
    network.listed_box = std::move(listed_box);

    Entries entries;
    for (std::size_t k = 0; k < network.pairs.size(); ++k) {
        const IndexPair moved{new_index[network.pairs[k].a], new_index[network.pairs[k].b]};
        if (moved.a < 0 || moved.b < 0) continue;
        const bool opposite = moved.a > moved.b;
        entries.pairs.push_back(
            {opposite ? IndexPair{moved.b, moved.a} : moved, {static_cast<std::int32_t>(k), opposite}});
    }
    for (std::size_t k = 0; k < network.wall_pairs.size(); ++k) {
        const auto& pair = network.wall_pairs[k];
        if (new_index[pair.sphere] >= 0)
            entries.walls.push_back(
                {new_index[pair.sphere], pair.wall, pair.first, pair.patches, static_cast<std::int32_t>(k)});
    }
    entries.patches = network.patches;
    lay_down(network, entries, state, model);
}

} // namespace talus
