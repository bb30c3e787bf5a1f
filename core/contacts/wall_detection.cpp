// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/wall_detection.hpp"

#include <algorithm>

namespace talus
{
namespace
{

/// A point no higher above the tangent plane of a nearer contact is out of reach; in radii. Walls that are made to be
/// level differ by less.
constexpr double level = 1e-3;

constexpr int halvings = 20; ///< of a step, to find where a path comes nearest to an edge that it passes

bool hides(const WallPoint& near, const WallPoint& point, double radius)
{
    return near.normal.dot(point.point - near.point) <= level * radius;
}

} // namespace

Vec3 WallDetection::place(std::int32_t sphere) const
{
    const Vec3& x = state_.position[sphere];
    return x + model_.periodicity.shift_towards(x, network_.list.listed_box[sphere].center());
}

const std::vector<WallMeeting>& WallDetection::find(std::span<WallPair> pairs)
{
    meetings_.clear();
    const std::int32_t sphere = pairs.front().sphere;
    const Vec3 x = place(sphere);
    const double radius = state_.radius(sphere);
    for (WallPair& pair : pairs)
        if (walls_[pair.wall].stands()) add_points(pair, x, radius + touching_gap * step_.law.min_diameter);
    drop_hidden(0, 0, radius);
    const std::size_t touching = meetings_.size();
    for (WallPair& pair : pairs)
        if (walls_[pair.wall].stands()) add_gaps(pair, x, touching);
    if (meetings_.size() > touching) {
        drop_hidden(touching, touching, radius);
        std::ranges::stable_sort(meetings_, {}, [](const WallMeeting& meeting) { return meeting.pair; });
    }
    return meetings_;
}

void WallDetection::add_points(WallPair& pair, const Vec3& x, double radius)
{
    points_.clear();
    find_wall_points(walls_[pair.wall], network_.list.patches.data() + pair.first, pair.patches, x, radius, points_);
    for (const WallPoint& at : points_) meetings_.push_back({&pair, at});
}

/// Gaps that close within the horizon, or are small. @param touching so many meetings are none
void WallDetection::add_gaps(WallPair& pair, const Vec3& x, std::size_t touching)
{
    const std::vector<WallMeeting> known(meetings_.begin(), meetings_.begin() + static_cast<std::ptrdiff_t>(touching));
    const auto touched = [&](std::int32_t patch) {
        return std::ranges::any_of(
            known, [&](const WallMeeting& meeting) { return meeting.pair == &pair && meeting.at.patch == patch; });
    };
    const std::int32_t* patches = network_.list.patches.data() + pair.first;
    if (pair.patches == 1 && touched(patches[0])) return;
    const PlacedWall& wall = walls_[pair.wall];
    const Motion& m = state_.motion[pair.sphere];
    Vec3 velocity = free_velocity(wall, m, x, static_cast<std::size_t>(patches[0]));
    // What bears the sphere lets it sink no further: else it would meet the rims of what is level with it.
    for (const WallMeeting& meeting : known)
        velocity -= std::min(0.0, meeting.at.normal.dot(velocity)) * meeting.at.normal;
    const double reach = std::max(step_.reach, step_.horizon * velocity.norm());
    const std::size_t first = meetings_.size();
    add_points(pair, x + step_.law.h * velocity, m.radius + reach);
    for (std::size_t k = first; k < meetings_.size(); ++k)
        meetings_[k].at = nearest_on_path(wall, meetings_[k].at, x, velocity);
    const auto is_none = [&](const WallMeeting& meeting) {
        const double gap = meeting.at.normal.dot(x - meeting.at.point) - m.radius;
        const double u_n = meeting.at.normal.dot(velocity);
        return touched(meeting.at.patch) || (gap > step_.reach && gap + step_.horizon * u_n > 0.0);
    };
    meetings_.erase(std::remove_if(meetings_.begin() + static_cast<std::ptrdiff_t>(first), meetings_.end(), is_none),
        meetings_.end());
}

/// Drops meetings from `from` on that lie behind a nearer one of them, or behind one of the first `behind_all`.
void WallDetection::drop_hidden(std::size_t from, std::size_t behind_all, double radius)
{
    const auto is_hidden = [&](std::size_t k) {
        const WallPoint& point = meetings_[k].at;
        for (std::size_t j = 0; j < meetings_.size(); ++j) {
            const WallPoint& other = meetings_[j].at;
            const bool nearer =
                j < behind_all || (j >= from && j != k &&
                                      (other.distance < point.distance || (other.distance == point.distance && j < k)));
            if (nearer && hides(other, point, radius)) return true;
        }
        return false;
    };
    if (meetings_.size() - from + behind_all < 2) return;
    std::vector<WallMeeting> seen(meetings_.begin(), meetings_.begin() + static_cast<std::ptrdiff_t>(from));
    for (std::size_t k = from; k < meetings_.size(); ++k)
        if (!is_hidden(k)) seen.push_back(meetings_[k]);
    meetings_ = std::move(seen);
}

/// Of the sphere against the wall's material at its place, if nothing touched them [m/s].
Vec3 WallDetection::free_velocity(const PlacedWall& wall, const Motion& motion, const Vec3& x, std::size_t patch) const
{
    const Vec3 free = motion.velocity + step_.law.h * model_.gravity;
    return wall.moves() ? Vec3(free - wall.velocity(patch, x) - wall.gain()) : free;
}

/// The nearest point of the patch to the path from x, which ends where `at_end` is seen from.
WallPoint WallDetection::nearest_on_path(
    const PlacedWall& wall, const WallPoint& at_end, const Vec3& x, const Vec3& velocity) const
{
    if (at_end.normal.dot(velocity) <= 0.0) return at_end;
    const auto patch = static_cast<std::size_t>(at_end.patch);
    double early = 0.0, late = step_.law.h;
    WallPoint at = wall.nearest_point(patch, x);
    if (at.normal.dot(velocity) >= 0.0) return at;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (early + late);
        at = wall.nearest_point(patch, x + middle * velocity);
        (at.normal.dot(velocity) < 0.0 ? early : late) = middle;
    }
    return at;
}

WallTouch WallDetection::touch(const WallMeeting& meeting, std::uint32_t slot) const
{
    const WallPair& pair = *meeting.pair;
    const PlacedWall& wall = walls_[pair.wall];
    const Motion& m = state_.motion[pair.sphere];
    const Vec3 x = place(pair.sphere);
    const Vec3& n = meeting.at.normal;
    const double gap = n.dot(x - meeting.at.point) - m.radius;
    const auto patch = static_cast<std::size_t>(meeting.at.patch);
    const WallRow row = wall.moves() ? WallRow{wall.velocity(patch, x - m.radius * n), wall.spin()} : WallRow{};
    const double gain = wall.moves() ? n.dot(row.velocity - wall.velocity_before(patch, x - m.radius * n)) : 0.0;
    const double u_n = n.dot(m.velocity - row.velocity);
    const double u_n_ahead = u_n + step_.law.h * n.dot(model_.gravity) - n.dot(wall.gain());
    const double wall_inverse_mass = wall.is_piston() ? 1.0 / model_.pistons[wall.wall().piston].mass : 0.0;
    const double way_ahead = wall.is_piston() ? 0.0 : step_.law.h * n.dot(row.velocity); // where that is known
    return {.sphere = pair.sphere,
        .wall = pair.wall,
        .normal = n,
        .gap = gap,
        .u_n = u_n,
        .u_n_before = u_n + gain,
        .closes = u_n_ahead < 0.0 ? -gap / u_n_ahead : infinity,
        .inverse_mass_sum = m.inverse_mass + wall_inverse_mass,
        .slot = slot,
        .wall_level = n.dot(state_.position[pair.sphere]) - gap + way_ahead,
        .row = {row.velocity, row.spin, gain}};
}

} // namespace talus
