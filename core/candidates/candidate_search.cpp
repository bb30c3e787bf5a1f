// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/candidate_search.hpp"

#include "core/candidates/candidate_layout.hpp"

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
    if (static_cast<std::size_t>(pair.a) >= network.first_pair.size()) return EntrySource::none;
    const auto begin = network.first_pair[pair.a];
    for (auto k = begin; k < begin + network.pair_count[pair.a]; ++k)
        if (network.pairs[network.pair_of_sphere[k]].b == pair.b)
            return static_cast<std::int32_t>(network.pair_of_sphere[k]);
    return EntrySource::none;
}

std::int32_t find_old_wall_pair(const ContactNetwork& network, std::int32_t sphere, std::int32_t wall)
{
    if (static_cast<std::size_t>(sphere) >= network.first_wall_pair.size()) return EntrySource::none;
    const auto begin = network.first_wall_pair[sphere];
    for (auto k = begin; k < begin + network.wall_pair_count[sphere]; ++k)
        if (network.wall_pairs[k].wall == wall) return static_cast<std::int32_t>(k);
    return EntrySource::none;
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

void search_spheres(CandidateEntries& entries, const ContactNetwork& network, const State& state, const Model& model,
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
    WallSearch(CandidateEntries& entries, const ContactNetwork& network, const Model& model,
        const std::vector<PlacedWall>& walls)
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
    CandidateEntries& entries_;
    const ContactNetwork& network_;
    const std::vector<PlacedWall>& walls_;
    std::vector<double> margin_; ///< by wall [m]
};

void search_walls(CandidateEntries& entries, const ContactNetwork& network, const Model& model,
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

    CandidateEntries entries;
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

    CandidateEntries entries;
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
