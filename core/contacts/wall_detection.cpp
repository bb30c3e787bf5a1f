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
    now_.clear();
    const std::int32_t sphere = pairs.front().sphere;
    x_ = place(sphere);
    const double radius = state_.radius[sphere];
    if (model_.physics.attraction) note_attached(pairs);
    for (WallPair& pair : pairs)
        if (walls_[pair.wall].stands()) add_touching(pair, radius + touching_gap * step_.law.min_diameter);
    drop_hidden(0, 0, radius);
    const std::size_t touching = meetings_.size();
    const WallPoint* now = now_.data();
    for (WallPair& pair : pairs) {
        if (!walls_[pair.wall].stands()) continue;
        add_gaps(pair, {now, pair.patches}, touching);
        now += pair.patches;
    }
    if (meetings_.size() > touching) {
        drop_hidden(touching, touching, radius);
        const auto pair_of = [](const WallMeeting& meeting) { return meeting.pair; };
        if (!std::ranges::is_sorted(meetings_, {}, pair_of)) std::ranges::stable_sort(meetings_, {}, pair_of);
    }
    return meetings_;
}

void WallDetection::note_attached(std::span<const WallPair> pairs)
{
    attached_.clear();
    for (const WallPair& pair : pairs)
        for (std::uint32_t k = 0; k < pair.carried; ++k) {
            const CarriedContact& carried = network_.carried.walls.contact[pair.first + k];
            if (carried.attached || carried.touch.last() != TouchRecord::unloaded)
                attached_.push_back(network_.carried.wall_normal[pair.first + k]);
        }
}

void WallDetection::stay_attached(const WallPair& pair)
{
    for (std::uint32_t k = 0; k < pair.carried; ++k) {
        const Vec3& normal = network_.carried.wall_normal[pair.first + k];
        if (std::ranges::any_of(attached_, [&](const Vec3& other) { return other.dot(normal) > same_contact; }))
            network_.carried.walls.contact[pair.first + k].attached = true;
    }
}

void WallDetection::add_touching(WallPair& pair, double reach)
{
    const PlacedWall& wall = walls_[pair.wall];
    points_.clear();
    for (std::uint32_t k = 0; k < pair.patches; ++k) {
        now_.push_back(wall.nearest_point(static_cast<std::size_t>(network_.list.patches[pair.first + k]), x_));
        if (now_.back().distance <= reach) points_.push_back(now_.back());
    }
    keep_local_minima(wall, reach, points_);
    for (const WallPoint& at : points_) meetings_.push_back({&pair, at});
}

/// Gaps that close within the horizon, or are small. @param touching so many meetings are none
void WallDetection::add_gaps(WallPair& pair, std::span<const WallPoint> now, std::size_t touching)
{
    const auto touched = [&](const WallPoint& at) {
        return std::any_of(meetings_.begin(), meetings_.begin() + static_cast<std::ptrdiff_t>(touching),
            [&](const WallMeeting& meeting) { return meeting.pair == &pair && meeting.at.patch == at.patch; });
    };
    if (std::ranges::all_of(now, touched)) return;

    const PlacedWall& wall = walls_[pair.wall];
    Vec3 velocity = free_velocity(wall, state_.body(pair.sphere), static_cast<std::size_t>(now.front().patch));
    // What bears the sphere lets it sink no further: else it would meet the rims of what is level with it.
    for (std::size_t k = 0; k < touching; ++k) {
        const Vec3& normal = meetings_[k].at.normal;
        velocity -= std::min(0.0, normal.dot(velocity)) * normal;
    }
    const double speed = velocity.norm(),
                 reach = state_.radius[pair.sphere] + std::max(step_.reach, step_.horizon * speed);
    const auto is_near = [&](const WallPoint& at) { return at.distance <= reach + step_.law.h * speed; };
    if (std::ranges::none_of(now, [&](const WallPoint& at) { return is_near(at) && !touched(at); })) return;

    points_.clear();
    for (const WallPoint& at : now) {
        if (!is_near(at)) continue;
        points_.push_back(wall.nearest_point(static_cast<std::size_t>(at.patch), x_ + step_.law.h * velocity));
        if (points_.back().distance > reach) points_.pop_back();
    }
    keep_local_minima(wall, reach, points_);
    for (const WallPoint& at_end : points_) {
        if (touched(at_end)) continue;
        const WallPoint at =
            nearest_on_path(wall, *std::ranges::find(now, at_end.patch, &WallPoint::patch), at_end, velocity);
        const double gap = at.normal.dot(x_ - at.point) - state_.radius[pair.sphere], u_n = at.normal.dot(velocity);
        if (gap <= step_.reach || gap + step_.horizon * u_n <= 0.0) meetings_.push_back({&pair, at});
    }
}

/// Drops meetings from `from` on that lie behind a nearer one of them, or behind one of the first `behind_all`.
void WallDetection::drop_hidden(std::size_t from, std::size_t behind_all, double radius)
{
    if (meetings_.size() - from + behind_all < 2) return;
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
    hidden_.assign(meetings_.size(), 0);
    for (std::size_t k = from; k < meetings_.size(); ++k) hidden_[k] = is_hidden(k);
    auto kept = meetings_.begin() + static_cast<std::ptrdiff_t>(from);
    for (std::size_t k = from; k < meetings_.size(); ++k)
        if (hidden_[k] == 0) *kept++ = meetings_[k];
    meetings_.erase(kept, meetings_.end());
}

/// Of the sphere against the wall's material at its place, if nothing touched them [m/s].
Vec3 WallDetection::free_velocity(const PlacedWall& wall, const Body& body, std::size_t patch) const
{
    const Vec3 free = body.velocity + step_.law.h * model_.gravity;
    return wall.moves() ? Vec3(free - wall.velocity(patch, x_) - wall.gain()) : free;
}

/// The nearest point of the patch to the path, which ends where `at_end` is seen from.
WallPoint WallDetection::nearest_on_path(
    const PlacedWall& wall, const WallPoint& now, const WallPoint& at_end, const Vec3& velocity) const
{
    if (at_end.normal.dot(velocity) <= 0.0) return at_end;
    if (now.normal.dot(velocity) >= 0.0) return now;
    double early = 0.0, late = step_.law.h;
    WallPoint at = now;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (early + late);
        const WallPoint next = wall.nearest_point(static_cast<std::size_t>(now.patch), x_ + middle * velocity);
        const bool before = next.normal.dot(velocity) < 0.0;
        (before ? early : late) = middle;
        if (before) at = next; // beyond the middle of a wall without thickness its normal is that of the other side
    }
    return at;
}

WallTouch WallDetection::touch(const WallMeeting& meeting, std::uint32_t slot) const
{
    const WallPair& pair = *meeting.pair;
    const PlacedWall& wall = walls_[pair.wall];
    const Body& body = state_.body(pair.sphere);
    const double radius = state_.radius[pair.sphere];
    const Vec3& n = meeting.at.normal;
    const double gap = n.dot(x_ - meeting.at.point) - radius;
    const auto patch = static_cast<std::size_t>(meeting.at.patch);
    const WallRow row = wall.moves() ? WallRow{wall.velocity(patch, x_ - radius * n), wall.spin()} : WallRow{};
    const double gain = wall.moves() ? n.dot(row.velocity - wall.velocity_before(patch, x_ - radius * n)) : 0.0;
    const double u_n = n.dot(body.velocity - row.velocity);
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
        .inverse_mass_sum = body.inverse_mass + wall_inverse_mass,
        .slot = slot,
        .wall_level = n.dot(state_.position[pair.sphere]) - gap + way_ahead,
        .row = {row.velocity, row.spin, gain}};
}

} // namespace talus
