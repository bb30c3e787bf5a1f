// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/periodicity.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"
#include "core/world/wall.hpp"

#include <vector>

namespace talus
{

/// A wall as it stands at a time, with its images along periodic axes: what search and assembly see of it.
///
/// Its patches are those of the shape, once for each image: patch k of image i is number i × (patches of the shape) +
/// k. Points and normals are in the world's frame; the shape, and a mesh's tree, stay in the wall's own.
class PlacedWall
{
public:
    /// @param step h [s] over which `velocity` is the mean; 0: only the place is wanted
    PlacedWall(const Wall& wall, const Periodicity& periodicity, double time, double step = 0.0);

    /// The wall of a piston, which is where forces have brought it.
    /// @param gain what the step would add to its velocity if nothing touched it [m/s]
    PlacedWall(const Wall& wall, const Periodicity& periodicity, const Piston& piston, const PistonState& state,
        const Vec3& gain);

    const Wall& wall() const { return *wall_; }
    const Pose& pose() const { return pose_; } ///< of the first image
    bool stands() const { return stands_; }
    bool moves() const { return wall_->moves(); }
    bool is_piston() const { return wall_->is_piston(); }

    std::size_t patch_count() const { return images_.size() * shape_patches_; }

    /// The point of a patch nearest to x.
    WallPoint nearest_point(std::size_t patch, const Vec3& x) const;

    /// Appends the patches that may meet the box (all that do, perhaps a few more) in ascending order.
    void patches_near(const Box& box, std::vector<std::int32_t>& patches) const;

    /// The gap between the wall and the ball [m], or infinity where it is wider than `within`.
    double gap(const Vec3& center, double radius, double within = 0.0) const;

    /// The velocity of the wall's material at a place near this patch [m/s]: the mean over the step that begins now; of
    /// a piston, that with which it begins, and the step may add `gain`.
    Vec3 velocity(std::size_t patch, const Vec3& x) const { return twist_.at(x - image_of(patch)); }
    /// The same over as long a time before [m/s].
    Vec3 velocity_before(std::size_t patch, const Vec3& x) const { return twist_before_.at(x - image_of(patch)); }
    const Vec3& spin() const { return twist_.spin; } ///< as `velocity` [rad/s]
    const Vec3& gain() const { return gain_; }       ///< zero but for pistons [m/s]

    /// By how much the image that this patch belongs to is shifted [m].
    const Vec3& image_of(std::size_t patch) const { return images_[patch / shape_patches_]; }

    /// The fastest that the material of any image moves, or may come to move in the step, anywhere in the box [m/s].
    double fastest(const Box& box) const;

    /// The longest way that the material of any image has made in the box since the wall stood at `before` [m].
    double way_since(const Pose& before, const Box& box) const;

private:
    const Wall* wall_;
    std::size_t shape_patches_;
    std::vector<Vec3> images_; ///< shifts [m], the first is zero
    Pose pose_, back_;
    Twist twist_, twist_before_;
    Vec3 gain_ = Vec3::Zero();
    bool stands_;
};

/// All walls as they stand.
/// @param step h [s] over which velocities are means; 0: only the places are wanted
std::vector<PlacedWall> place_walls(const Model& model, const State& state, double step = 0.0);

/// All walls at the beginning of a run: pistons where the scene puts them.
std::vector<PlacedWall> place_walls_at_start(const Model& model);

/// Whether the ball reaches into a wall that stands.
bool touches_wall(const std::vector<PlacedWall>& walls, const Vec3& center, double radius);

/// How far a piston has come [m]. @param began how its wall stood then
Vec3 way_of(const PlacedWall& began, const Model& model, const State& state);

/// The longest way that a point of the box makes from one pose of a wall to another [m].
double longest_way(const Pose& from, const Pose& to, const Box& box);

} // namespace talus
