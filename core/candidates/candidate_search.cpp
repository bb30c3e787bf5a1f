// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_search.hpp"

#include <algorithm>

namespace talus
{
namespace
{

constexpr double skin = 0.08;        ///< growth of a listed box on each side, in smallest diameters …
constexpr double skin_per_way = 0.2; ///< … and this share of what it is drawn out: fast grains stray more
constexpr double horizon_steps = 20; ///< steps along its way for which a listed box is drawn out …
constexpr double longest_way = 1.0;  ///< … but with what it needs now by this many smallest diameters at most
constexpr double tile_diameters =
    6.0;                            ///< a tile's edge at least, in mean diameters: packs of smaller ones are less full
constexpr double used_share = 0.25; ///< a sphere that has used up so much of its skin is searched for with others …
constexpr double steps_ahead = 4.0; ///< … and so is one that will have, after so many steps more
constexpr double wall_skin = 0.2;   ///< how far a wall may move before it is searched for anew, in smallest diameters

/// Room around the centre of sphere i that its surface takes, with half the reach of its contacts.
double needed_radius(const State& state, const Model& model, std::size_t i)
{
    return state.radius[i] + 0.5 * contact_reach(model) * model.min_diameter;
}

/// The room that sphere i takes, and would take after the closing horizon, with the reach of its contacts.
Box needed_box(const State& state, const Model& model, double h, std::size_t i)
{
    const Vec3& x = state.position[i];
    const Vec3 move = closing_horizon * h * (state.body(i).velocity + h * model.gravity);
    return Box{x, x}.extend(Vec3(x + move)).grown(needed_radius(state, model, i));
}

/// The room that a box takes on its way.
Box swept_box(const Box& box, const Vec3& way)
{
    return Box(box).extend(box.shifted(way));
}

Box new_listed_box(const State& state, const Model& model, double h, std::size_t i)
{
    const double t = horizon_steps * h;
    Vec3 way = t * state.body(i).velocity + 0.5 * t * t * model.gravity;
    const Box now = needed_box(state, model, h, i);
    const double way_now = now.extent().maxCoeff() - 2.0 * needed_radius(state, model, i);
    const double longest = std::max(0.0, longest_way * model.min_diameter - way_now);
    if (way.norm() > longest) way *= longest / way.norm();
    return swept_box(now, way).grown(skin * model.min_diameter + skin_per_way * way.norm());
}

/// A listed box is no longer than this along an axis, but that of a sphere which moves further in a step than spheres
/// should.
double usual_box_length(const Model& model)
{
    const double way = longest_way * (1.0 + 2.0 * skin_per_way);
    return model.max_diameter + (contact_reach(model) + 2.0 * skin + way) * model.min_diameter;
}

/// The edge of the tiles: twice what two boxes that meet can be apart by their centres; for longer ones it is doubled.
/// It does not become shorter.
double tile_edge(const CandidateList& list, const Model& model, const std::vector<std::int32_t>& movers)
{
    constexpr double rounding = 1.0005;
    double longest = usual_box_length(model);
    for (const auto i : movers) longest = std::max(longest, list.listed_box[i].extent().maxCoeff());
    double edge = list.tile_edge > 0.0
                      ? list.tile_edge
                      : std::max(2.0 * rounding * usual_box_length(model), tile_diameters * model.mean_diameter);
    while (edge < 2.0 * rounding * longest && longest < infinity) edge *= 2.0;
    return edge;
}

/// The spheres whose listed box no longer serves; when there are any, those whose skin is nearly used up too.
std::vector<std::int32_t> spheres_to_search(const CandidateList& list, const State& state, const Model& model, double h)
{
    const auto count = static_cast<std::int64_t>(state.count());
    std::vector<std::uint8_t> wear(state.count(), 0);
    bool any_left = false;
#pragma omp parallel for schedule(static) reduction(|| : any_left) if (count > 1000)
    for (std::int64_t i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3 shift = model.periodicity.shift_towards(state.position[k], list.listed_box[k].center());
        const Box needed = needed_box(state, model, h, k).shifted(shift);
        const bool left = !list.listed_box[k].contains(needed);
        const Box soon = swept_box(needed, steps_ahead * h * state.body(k).velocity);
        const bool used_up = !list.listed_box[k].contains(soon.grown((1.0 - used_share) * skin * model.min_diameter));
        wear[k] = left || used_up;
        any_left = any_left || left;
    }
    std::vector<std::int32_t> result;
    if (any_left)
        for (std::int64_t i = 0; i < count; ++i)
            if (wear[static_cast<std::size_t>(i)]) result.push_back(static_cast<std::int32_t>(i));
    return result;
}

/// Where the old list has a wall pair, for a new one to find what it carried.
class OldWallPairs
{
public:
    OldWallPairs(const CandidateList& list, std::size_t spheres) : list_(list), first_(spheres, not_listed)
    {
        for (std::size_t k = list.wall_pairs.size(); k-- > 0;)
            first_[list.wall_pairs[k].sphere] = static_cast<std::int32_t>(k);
    }

    std::int32_t find(std::int32_t sphere, std::int32_t wall) const
    {
        if (first_[sphere] == not_listed) return not_listed;
        for (auto k = static_cast<std::size_t>(first_[sphere]); k < list_.wall_pairs.size(); ++k) {
            if (list_.wall_pairs[k].sphere != sphere) break;
            if (list_.wall_pairs[k].wall == wall) return static_cast<std::int32_t>(k);
        }
        return not_listed;
    }

private:
    const CandidateList& list_;
    std::vector<std::int32_t> first_; ///< by sphere
};

/// Whether two spheres can come within reach of each other while each stays inside its listed box.
bool can_touch(const CandidateList& list, const State& state, const Model& model, const IndexPair& pair)
{
    const double ra = needed_radius(state, model, static_cast<std::size_t>(pair.a));
    const double rb = needed_radius(state, model, static_cast<std::size_t>(pair.b));
    const Box a = list.listed_box[pair.a].grown(-ra);
    const Box b = list.listed_box[pair.b].grown(-rb);
    return model.periodicity.apart(a, b).squaredNorm() <= (ra + rb) * (ra + rb);
}

/// The pairs with at least one member in `movers`; when nothing has been listed yet, all.
std::vector<IndexPair> pairs_of(
    const std::vector<std::int32_t>& movers, const CandidateList& list, const State& state, const Model& model)
{
    auto met = list.tile_edge > 0.0 ? find_box_pairs(list.listed_box, movers, model.periodicity)
                                    : find_box_pairs(list.listed_box, model.periodicity);
    std::vector<std::uint8_t> serves(met.size());
#pragma omp parallel for schedule(static) if (met.size() > 10000)
    for (std::size_t k = 0; k < met.size(); ++k) serves[k] = can_touch(list, state, model, met[k]);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < met.size(); ++k) {
        met[kept] = met[k];
        kept += serves[k];
    }
    met.resize(kept);
    return met;
}

/// The walls that have moved so far since they were listed, or will in this step, that their lists may miss a sphere.
std::vector<std::uint8_t> walls_to_search(
    const CandidateList& list, const Model& model, double h, const std::vector<PlacedWall>& walls)
{
    std::vector<std::uint8_t> stale(walls.size(), 0);
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (!walls[w].moves()) continue;
        if (!list.listed_pose.empty()) {
            const double way = walls[w].way_since(list.listed_pose[w], list.listed_around);
            const double ahead = closing_horizon * h * walls[w].fastest(list.listed_around);
            if (way + ahead <= wall_skin * model.min_diameter) continue;
        }
        stale[w] = 1;
    }
    return stale;
}

constexpr std::size_t searched_at_once = 1024; ///< spheres that a thread searches walls for

/// Who lies near which wall.
class WallSearch
{
public:
    WallSearch(const CandidateList& list, const Model& model, double h, const std::vector<PlacedWall>& walls,
        const std::vector<std::int32_t>& movers, const std::vector<std::uint8_t>& moves,
        const std::vector<std::uint8_t>& stale)
        : list_(list), old_(list, list.listed_box.size()), walls_(walls), movers_(movers), moves_(moves), stale_(stale)
    {
        // A wall does not come half of the way, as another sphere does.
        const double reach = 0.5 * contact_reach(model) * model.min_diameter;
        for (const auto& wall : walls) {
            // One skin that it may have moved already, where a sphere is searched for alone, and one for the future.
            const double ahead = closing_horizon * h * wall.fastest(list.listed_around);
            margin_.push_back(wall.moves() ? reach + 2.0 * wall_skin * model.min_diameter + ahead : reach);
        }
    }

    /// All walls near movers, stale ones near all spheres, and what the old list knows of the others.
    WallEntries search() const
    {
        const bool any_stale = std::ranges::find(stale_, 1) != stale_.end();
        const std::size_t spheres = any_stale ? list_.listed_box.size() : movers_.size();
        std::vector<WallEntries> found((spheres + searched_at_once - 1) / searched_at_once);
#pragma omp parallel for schedule(dynamic) if (found.size() > 1)
        for (std::size_t part = 0; part < found.size(); ++part)
            for (std::size_t k = part * searched_at_once; k < std::min(spheres, (part + 1) * searched_at_once); ++k)
                search_around(any_stale ? static_cast<std::int32_t>(k) : movers_[k], found[part]);
        WallEntries all;
        for (const WallEntries& part : found)
            for (const WallEntry& e : part.walls) append(e, part.patches, all);
        for (std::size_t k = 0; k < list_.wall_pairs.size(); ++k) {
            const WallPair& old = list_.wall_pairs[k];
            if (moves_[static_cast<std::size_t>(old.sphere)] || stale_[static_cast<std::size_t>(old.wall)]) continue;
            append({old.sphere, old.wall, old.first, old.patches, static_cast<std::int32_t>(k)}, list_.patches, all);
        }
        return all;
    }

private:
    const CandidateList& list_;
    const OldWallPairs old_;
    const std::vector<PlacedWall>& walls_;
    const std::vector<std::int32_t>& movers_;
    const std::vector<std::uint8_t>& moves_; ///< by sphere
    const std::vector<std::uint8_t>& stale_; ///< by wall
    std::vector<double> margin_;             ///< by wall [m]

    void search_around(std::int32_t sphere, WallEntries& entries) const
    {
        for (std::size_t w = 0; w < walls_.size(); ++w) {
            if (!moves_[static_cast<std::size_t>(sphere)] && !stale_[w]) continue;
            const auto first = static_cast<std::uint32_t>(entries.patches.size());
            walls_[w].patches_near(
                list_.listed_box[static_cast<std::size_t>(sphere)].grown(margin_[w]), entries.patches);
            const auto patches = static_cast<std::uint32_t>(entries.patches.size()) - first;
            const auto wall = static_cast<std::int32_t>(w);
            if (patches > 0) entries.walls.push_back({sphere, wall, first, patches, old_.find(sphere, wall)});
        }
    }

    static void append(WallEntry entry, const std::vector<std::int32_t>& patches, WallEntries& to)
    {
        const auto first = patches.begin() + entry.first;
        entry.first = static_cast<std::uint32_t>(to.patches.size());
        to.patches.insert(to.patches.end(), first, first + entry.patches);
        to.walls.push_back(entry);
    }
};

/// Brings the pairs up to date where these spheres have new boxes.
void list_anew(CandidateList& list, Carried& carried, const State& state, const Model& model,
    const std::vector<std::int32_t>& movers, const std::vector<std::uint8_t>& moves, const WallEntries& walls)
{
    auto found = pairs_of(movers, list, state, model);
    const double edge = tile_edge(list, model, movers);
    if (edge == list.tile_edge) {
        lay_down(list, carried, found, take_pairs(list.tiles, moves, model.physics.rolling), walls, model);
        return;
    }
    // All pairs go to other tiles.
    list.tile_edge = edge;
    const std::vector<std::uint8_t> all(state.count(), 1);
    const LoosePairs taken = take_pairs(list.tiles, all, model.physics.rolling);
    for (const IndexPair& pair : taken.pairs)
        if (!moves[static_cast<std::size_t>(pair.a)] && !moves[static_cast<std::size_t>(pair.b)]) found.push_back(pair);
    list.tiles = {};
    lay_down(list, carried, found, taken, walls, model);
}

} // namespace

std::size_t update_candidates(CandidateList& list, Carried& carried, const State& state, const Model& model, double h,
    const std::vector<PlacedWall>& walls)
{
    list.listed_box.resize(state.count());
    const auto movers = spheres_to_search(list, state, model, h);
    const auto stale = walls_to_search(list, model, h, walls);
    const bool any_stale = std::find(stale.begin(), stale.end(), 1) != stale.end();
    if (movers.empty() && !any_stale) return 0;
#pragma omp parallel for schedule(static) if (movers.size() > 1000)
    for (std::size_t k = 0; k < movers.size(); ++k) {
        const auto i = static_cast<std::size_t>(movers[k]);
        list.listed_box[i] = new_listed_box(state, model, h, i);
    }
    if (std::ranges::any_of(walls, [](const PlacedWall& wall) { return wall.moves(); })) {
        list.listed_around = Box{};
        for (const Box& box : list.listed_box) list.listed_around.extend(box);
    }
    std::vector<std::uint8_t> moves(state.count(), 0);
    for (const auto i : movers) moves[static_cast<std::size_t>(i)] = 1;
    const WallEntries near_walls = WallSearch(list, model, h, walls, movers, moves, stale).search();
    list.listed_pose.resize(walls.size());
    for (std::size_t w = 0; w < walls.size(); ++w)
        if (stale[w]) list.listed_pose[w] = walls[w].pose();
    list_anew(list, carried, state, model, movers, moves, near_walls);
    return movers.size();
}

void renumber_candidates(CandidateList& list, Carried& carried, const State& state, const Model& model,
    const std::vector<std::int32_t>& new_index)
{
    std::vector<Box> listed_box(state.count());
    for (std::size_t i = 0; i < list.listed_box.size(); ++i) listed_box[new_index[i]] = list.listed_box[i];
    list.listed_box = std::move(listed_box);

    const std::vector<std::uint8_t> all(state.count(), 1);
    LoosePairs pairs = take_pairs(list.tiles, all, model.physics.rolling);
    for (std::size_t k = 0; k < pairs.pairs.size(); ++k) {
        IndexPair& pair = pairs.pairs[k];
        pair = {new_index[static_cast<std::size_t>(pair.a)], new_index[static_cast<std::size_t>(pair.b)]};
        if (pair.a < pair.b) continue;
        std::swap(pair.a, pair.b);
        pairs.carried.copy(k, pairs.carried, k, true);
    }
    WallEntries walls{{}, list.patches};
    for (std::size_t k = 0; k < list.wall_pairs.size(); ++k) {
        const auto& pair = list.wall_pairs[k];
        walls.walls.push_back(
            {new_index[pair.sphere], pair.wall, pair.first, pair.patches, static_cast<std::int32_t>(k)});
    }
    list.tiles = {};
    lay_down(list, carried, pairs.pairs, pairs, walls, model);
}

} // namespace talus
