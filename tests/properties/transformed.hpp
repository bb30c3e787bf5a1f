// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

namespace talus::test
{

/// The same world seen from elsewhere, in other units: x ↦ length · turn x + shift, and all else with it.
struct Transform {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< or a mirror
    Vec3 shift = Vec3::Zero();
    Vec3 boost = Vec3::Zero(); ///< added to all velocities; where nothing turns, and pistons go along it
    double length = 1.0, time = 1.0, mass = 1.0; ///< best powers of two: κ is kept in few digits
    bool reversed = false;                       ///< the order of the spheres in store, and so that of the sweeps

    Vec3 place(const Vec3& x) const { return length * (turn * x) + shift; }
    Vec3 arrow(const Vec3& v) const { return turn * v; }
    Vec3 axis(const Vec3& v) const { return turn.determinant() * (turn * v); } ///< of what turns
    Vec3 velocity(const Vec3& v) const { return length / time * (turn * v) + boost; }
};

/// With all that contacts carry, in a candidate list that is made anew; all of it in one tile, if it is small enough.
/// @param h of the step that comes [s]
World transformed(const World& world, const Transform& transform, double h);

} // namespace talus::test
