// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/placed_wall.hpp"

#include <algorithm>

namespace talus
{
namespace
{

/// The images of a wall; a plane is its own image, for it is as wide as the world.
std::vector<Vec3> images_of(const Shape& shape, const Periodicity& periodicity)
{
    if (std::holds_alternative<Plane>(shape)) return {Vec3::Zero()};
    return periodicity.neighbor_shifts();
}

/// The whole cells by which a wall that moves along a periodic axis for ever is put back: of all its images, the one
/// whose middle is nearest to where the wall began is the first.
Vec3 way_back(const Shape& shape, const Periodicity& periodicity, const Pose& pose)
{
    if (!periodicity.any() || std::holds_alternative<Plane>(shape)) return Vec3::Zero();
    const Vec3 middle = bounds(shape).center();
    return periodicity.shift_towards(pose(middle), middle);
}

} // namespace

PlacedWall::PlacedWall(const Wall& wall, const Periodicity& periodicity, double time, double step)
    : wall_(&wall), shape_patches_(talus::patch_count(wall.shape)), images_(images_of(wall.shape, periodicity)),
      stands_(wall.stands_at(time))
{
    if (wall.motion.empty()) return;
    const Vec3 cells = way_back(wall.shape, periodicity, pose_at(wall.motion, time));
    const auto first_image_at = [&](double when) {
        Pose pose = pose_at(wall.motion, when);
        pose.shift += cells;
        return pose;
    };
    pose_ = first_image_at(time);
    back_ = pose_.inverse();
    if (step <= 0.0) return;
    twist_ = twist_between(pose_, first_image_at(time + step), step);
    const bool has_begun = time > 0.5 * step; // a run that begins goes on as it began
    twist_before_ = has_begun ? twist_between(first_image_at(time - step), pose_, step) : twist_;
}

PlacedWall::PlacedWall(
    const Wall& wall, const Periodicity& periodicity, const Piston& piston, const PistonState& state, const Vec3& gain)
    : wall_(&wall), shape_patches_(talus::patch_count(wall.shape)), images_(images_of(wall.shape, periodicity)),
      pose_(state.pose), back_(pose_.inverse()), twist_(twist_of(piston, state)), twist_before_(twist_), gain_(gain),
      stands_(true)
{
}

WallPoint PlacedWall::nearest_point(std::size_t patch, const Vec3& x) const
{
    const auto of_shape = [&](std::size_t k, const Vec3& place) {
        auto at = talus::nearest_point(wall_->shape, k, place);
        at.patch = static_cast<std::int32_t>(patch);
        return at;
    };
    const auto image = patch / shape_patches_;
    if (image == 0 && !moves()) return of_shape(patch, x);
    auto at = of_shape(patch % shape_patches_, back_(x - images_[image]));
    at.point = pose_(at.point) + images_[image];
    at.normal = pose_.rotation * at.normal;
    return at;
}

void PlacedWall::patches_near(const Box& box, std::vector<std::int32_t>& patches) const
{
    for (std::size_t image = 0; image < images_.size(); ++image) {
        const Box shifted = box.shifted(-images_[image]);
        const auto first = patches.size();
        talus::patches_near(wall_->shape, moves() ? placed(back_, shifted) : shifted, patches);
        for (auto k = first; k < patches.size(); ++k) patches[k] += static_cast<std::int32_t>(image * shape_patches_);
    }
}

double PlacedWall::gap(const Vec3& center, double radius, double within) const
{
    std::vector<std::int32_t> patches;
    patches_near(Box{center, center}.grown(radius + within), patches);
    double least = infinity;
    for (const auto k : patches)
        least = std::min(least, nearest_point(static_cast<std::size_t>(k), center).distance - radius);
    return least <= within ? least : infinity;
}

double PlacedWall::fastest(const Box& box) const
{
    const double most_gained = gain_.norm();
    if (twist_.spin.isZero(0.0)) return twist_.velocity.norm() + most_gained;
    double speed = 0.0;
    for (const Vec3& image : images_)
        for (const Vec3& x : box.corners()) speed = std::max(speed, twist_.at(x - image).norm());
    return speed + most_gained;
}

double PlacedWall::way_since(const Pose& before, const Box& box) const
{
    double longest = 0.0;
    for (const Vec3& image : images_) longest = std::max(longest, longest_way(before, pose_, box.shifted(-image)));
    return longest;
}

std::vector<PlacedWall> place_walls(const Model& model, const State& state, double step)
{
    std::vector<PlacedWall> result;
    result.reserve(model.walls.size());
    for (const auto& wall : model.walls) {
        if (!wall.is_piston()) {
            result.emplace_back(wall, model.periodicity, state.time, step);
            continue;
        }
        const Piston& piston = model.pistons[wall.piston];
        result.emplace_back(wall, model.periodicity, piston, state.pistons[wall.piston],
            piston.free_gain(model.gravity, state.time, step));
    }
    return result;
}

std::vector<PlacedWall> place_walls_at_start(const Model& model)
{
    State state;
    state.pistons.resize(model.pistons.size());
    return place_walls(model, state);
}

bool touches_wall(const std::vector<PlacedWall>& walls, const Vec3& center, double radius)
{
    return std::any_of(walls.begin(), walls.end(),
        [&](const PlacedWall& wall) { return wall.stands() && wall.gap(center, radius) < 0.0; });
}

Vec3 way_of(const PlacedWall& began, const Model& model, const State& state)
{
    const Vec3& center = model.pistons[began.wall().piston].center;
    return state.pistons[began.wall().piston].pose(center) - began.pose()(center);
}

double longest_way(const Pose& from, const Pose& to, const Box& box)
{
    const Pose change = to.after(from.inverse());
    double longest = 0.0;
    for (const Vec3& x : box.corners()) longest = std::max(longest, (change(x) - x).norm());
    return longest;
}

} // namespace talus
