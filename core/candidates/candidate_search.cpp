// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_search.hpp"

#include <algorithm>
#include <numeric>
#include <span>

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
Box needed_box(const State& state, const Model& model, double h, std::size_t i)
{
    const Vec3& x = state.position[i];
    const Vec3 move = closing_horizon * h * (state.motion[i].velocity + h * model.gravity);
    return Box{x, x}.extend(Vec3(x + move)).grown(needed_radius(state, model, i));
}

Box new_listed_box(const State& state, const Model& model, double h, std::size_t i)
{
    const double t = horizon_steps * h;
    Vec3 draw = t * state.motion[i].velocity + 0.5 * t * t * model.gravity;
    const double longest = longest_draw * model.min_diameter;
    if (draw.norm() > longest) draw *= longest / draw.norm();
    const Box now = needed_box(state, model, h, i);
    return Box(now)
        .extend(Box{now.min + draw, now.max + draw})
        .grown(skin * model.min_diameter + skin_per_draw * draw.norm());
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
        const bool worn = !list.listed_box[k].contains(needed.grown((1.0 - worn_share) * skin * model.min_diameter));
        wear[k] = left || worn;
        any_left = any_left || left;
    }
    std::vector<std::int32_t> result;
    if (any_left)
        for (std::int64_t i = 0; i < count; ++i)
            if (wear[static_cast<std::size_t>(i)]) result.push_back(static_cast<std::int32_t>(i));
    return result;
}

/// Where the old list has a pair, for a new one to find what it carried.
class OldPairs
{
public:
    OldPairs(const CandidateList& list, std::size_t spheres)
        : list_(list), first_(spheres + 1, 0), slots_(list.pairs.size()), first_wall_pair_(spheres, not_listed)
    {
        for (const IndexPair& pair : list.pairs) ++first_[pair.a + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        auto place = first_;
        for (std::size_t k = 0; k < list.pairs.size(); ++k)
            slots_[place[list.pairs[k].a]++] = static_cast<std::int32_t>(k);
        for (std::size_t k = list.wall_pairs.size(); k-- > 0;)
            first_wall_pair_[list.wall_pairs[k].sphere] = static_cast<std::int32_t>(k);
    }

    /// The slots of the pairs whose first sphere is i, in the order of their second.
    std::span<const std::int32_t> of(std::size_t i) const
    {
        return {slots_.data() + first_[i], slots_.data() + first_[i + 1]};
    }

    std::int32_t find_wall(std::int32_t sphere, std::int32_t wall) const
    {
        const auto first = first_wall_pair_[sphere];
        if (first == not_listed) return not_listed;
        for (auto k = static_cast<std::size_t>(first); k < list_.wall_pairs.size(); ++k) {
            if (list_.wall_pairs[k].sphere != sphere) break;
            if (list_.wall_pairs[k].wall == wall) return static_cast<std::int32_t>(k);
        }
        return not_listed;
    }

private:
    const CandidateList& list_;
    std::vector<std::uint32_t> first_;          ///< by sphere: its pairs in slots_; spheres + 1
    std::vector<std::int32_t> slots_;           ///< by the first sphere of their pair
    std::vector<std::int32_t> first_wall_pair_; ///< by sphere
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

/// Whether movers are searched for alone; else all spheres are.
bool are_few(const std::vector<std::int32_t>& movers, const CandidateList& list)
{
    return static_cast<double>(movers.size()) < few * static_cast<double>(list.listed_box.size());
}

/// The pairs with at least one member in `movers`, or all where these are not few, in order.
std::vector<IndexPair> pairs_of(
    const std::vector<std::int32_t>& movers, const CandidateList& list, const State& state, const Model& model)
{
    const auto met = are_few(movers, list) ? find_box_pairs(list.listed_box, movers, model.periodicity)
                                           : find_box_pairs(list.listed_box, model.periodicity);
    std::vector<std::uint32_t> first(state.count() + 1, 0);
    std::vector<std::uint8_t> serves(met.size());
#pragma omp parallel for schedule(static) if (met.size() > 10000)
    for (std::size_t k = 0; k < met.size(); ++k) serves[k] = can_touch(list, state, model, met[k]);
    for (std::size_t k = 0; k < met.size(); ++k)
        if (serves[k]) ++first[static_cast<std::size_t>(met[k].a) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<IndexPair> sorted(first.back());
    auto place = first;
    for (std::size_t k = 0; k < met.size(); ++k)
        if (serves[k]) sorted[place[static_cast<std::size_t>(met[k].a)]++] = met[k];
    for (std::size_t i = 0; i < state.count(); ++i) std::sort(sorted.begin() + first[i], sorted.begin() + first[i + 1]);
    return sorted;
}

/// New pairs of movers, and the old ones of all others. Both come in the order of their spheres.
void search_spheres(CandidateEntries& entries, const CandidateList& list, const OldPairs& old, const State& state,
    const Model& model, const std::vector<std::int32_t>& movers)
{
    const auto found = pairs_of(movers, list, state, model);
    std::vector<std::uint8_t> moves(list.listed_box.size(), !are_few(movers, list));
    for (const auto i : movers) moves[i] = 1;
    entries.pairs.reserve(list.pairs.size() + found.size());
    auto next = found.begin();
    for (std::size_t i = 0; i < state.count(); ++i) {
        const auto sphere = static_cast<std::int32_t>(i);
        for (const std::int32_t slot : old.of(i)) {
            const IndexPair& pair = list.pairs[static_cast<std::size_t>(slot)];
            for (; next != found.end() && *next < pair; ++next) entries.pairs.push_back({*next});
            if (next != found.end() && *next == pair)
                entries.pairs.push_back({*next++, slot});
            else if (!moves[i] && !moves[pair.b])
                entries.pairs.push_back({pair, slot});
        }
        for (; next != found.end() && next->a == sphere; ++next) entries.pairs.push_back({*next});
    }
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

/// Who lies near which wall, written into the entries sphere by sphere.
class WallSearch
{
public:
    WallSearch(CandidateEntries& entries, const CandidateList& list, const OldPairs& old, const Model& model, double h,
        const std::vector<PlacedWall>& walls)
        : entries_(entries), list_(list), old_(old), walls_(walls)
    {
        // A wall does not come half of the way, as another sphere does.
        const double reach = 0.5 * open_contact_reach * model.min_diameter;
        for (const auto& wall : walls) {
            // One skin that it may have moved already, where a sphere is searched for alone, and one for the future.
            const double ahead = closing_horizon * h * wall.fastest(list.listed_around);
            margin_.push_back(wall.moves() ? reach + 2.0 * wall_skin * model.min_diameter + ahead : reach);
        }
    }

    void search(std::int32_t sphere, std::size_t wall)
    {
        const auto first = static_cast<std::uint32_t>(entries_.patches.size());
        walls_[wall].patches_near(list_.listed_box[sphere].grown(margin_[wall]), entries_.patches);
        const auto patches = static_cast<std::uint32_t>(entries_.patches.size()) - first;
        const auto w = static_cast<std::int32_t>(wall);
        if (patches > 0) entries_.walls.push_back({sphere, w, first, patches, old_.find_wall(sphere, w)});
    }

    void keep(std::size_t old_pair)
    {
        const auto& old = list_.wall_pairs[old_pair];
        const auto first = static_cast<std::uint32_t>(entries_.patches.size());
        for (std::uint32_t p = 0; p < old.patches; ++p) entries_.patches.push_back(list_.patches[old.first + p]);
        entries_.walls.push_back({old.sphere, old.wall, first, old.patches, static_cast<std::int32_t>(old_pair)});
    }

private:
    CandidateEntries& entries_;
    const CandidateList& list_;
    const OldPairs& old_;
    const std::vector<PlacedWall>& walls_;
    std::vector<double> margin_; ///< by wall [m]
};

void search_walls(CandidateEntries& entries, const CandidateList& list, const OldPairs& old, const Model& model,
    double h, const std::vector<PlacedWall>& walls, const std::vector<std::int32_t>& movers,
    const std::vector<std::uint8_t>& stale)
{
    const auto spheres = static_cast<std::int32_t>(list.listed_box.size());
    std::vector<std::uint8_t> moves(list.listed_box.size(), 0);
    for (const auto i : movers) moves[i] = 1;
    WallSearch near(entries, list, old, model, h, walls);
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (stale[w])
            for (std::int32_t i = 0; i < spheres; ++i) near.search(i, w);
        else
            for (const auto i : movers) near.search(i, w);
    }
    for (std::size_t k = 0; k < list.wall_pairs.size(); ++k)
        if (!moves[list.wall_pairs[k].sphere] && !stale[list.wall_pairs[k].wall]) near.keep(k);
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
    for (const auto i : movers) list.listed_box[i] = new_listed_box(state, model, h, i);
    list.listed_around = Box{};
    for (const Box& box : list.listed_box) list.listed_around.extend(box);

    CandidateEntries entries;
    const OldPairs old(list, state.count());
    search_spheres(entries, list, old, state, model, movers);
    search_walls(entries, list, old, model, h, walls, movers, stale);
    list.listed_pose.resize(walls.size());
    for (std::size_t w = 0; w < walls.size(); ++w)
        if (stale[w]) list.listed_pose[w] = walls[w].pose();
    lay_down(list, carried, entries, state, model);
    return movers.size();
}

void renumber_candidates(CandidateList& list, Carried& carried, const State& state, const Model& model,
    const std::vector<std::int32_t>& new_index)
{
    std::vector<Box> listed_box(state.count());
    for (std::size_t i = 0; i < list.listed_box.size(); ++i) listed_box[new_index[i]] = list.listed_box[i];
    list.listed_box = std::move(listed_box);

    CandidateEntries entries;
    for (std::size_t k = 0; k < list.pairs.size(); ++k) {
        const IndexPair moved{new_index[list.pairs[k].a], new_index[list.pairs[k].b]};
        const bool opposite = moved.a > moved.b;
        entries.pairs.push_back(
            {opposite ? IndexPair{moved.b, moved.a} : moved, static_cast<std::int32_t>(k), opposite});
    }
    std::ranges::sort(entries.pairs, {}, &PairEntry::pair);
    for (std::size_t k = 0; k < list.wall_pairs.size(); ++k) {
        const auto& pair = list.wall_pairs[k];
        entries.walls.push_back(
            {new_index[pair.sphere], pair.wall, pair.first, pair.patches, static_cast<std::int32_t>(k)});
    }
    entries.patches = list.patches;
    lay_down(list, carried, entries, state, model);
}

} // namespace talus
