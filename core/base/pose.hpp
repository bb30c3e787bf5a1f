// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"

namespace talus
{

/// Where a rigid body is: a point X of its own frame lies at rotation X + shift.
struct Pose {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Vec3 shift = Vec3::Zero(); ///< [m]

    Vec3 operator()(const Vec3& x) const { return rotation * x + shift; }
    Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * shift)}; }

    /// The pose that comes of `first` and then this one.
    Pose after(const Pose& first) const { return {rotation * first.rotation, rotation * first.shift + shift}; }

    void persist(Archive& archive)
    {
        for (double& number : rotation.reshaped()) archive(number);
        archive(shift);
    }
};

/// The rigid velocity field v(x) = velocity + spin × x.
struct Twist {
    Vec3 velocity = Vec3::Zero(); ///< at the origin [m/s]
    Vec3 spin = Vec3::Zero();     ///< ω [rad/s]

    Vec3 at(const Vec3& x) const { return velocity + spin.cross(x); }
};

/// Turned by an angle [rad] about the line through `point` along the unit vector `axis`.
Pose turned_about(const Vec3& point, const Vec3& axis, double angle);

/// The constant twist that takes a body from one pose to another in a time h: the logarithm of the motion (Murray, Li &
/// Sastry 1994, A Mathematical Introduction to Robotic Manipulation, 2.3.3). A turn about a fixed axis comes out as
/// just that, so spheres in a round drum feel no radial velocity.
/// @pre turned by less than half a turn
Twist twist_between(const Pose& from, const Pose& to, double h);

/// The smallest box round a box that is put there.
Box placed(const Pose& pose, const Box& box);

} // namespace talus
