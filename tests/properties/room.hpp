// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

#include <Eigen/Dense>

#include <vector>

namespace talus::test
{

/// A place where bodies touch, or will within a step, as geometry alone tells it.
struct Touch {
    std::size_t a = 0; ///< sphere by storage index
    std::size_t b = 0; ///< sphere, or wall
    bool with_wall = false;
    Vec3 normal = Vec3::UnitZ(); ///< from b to a
    Vec3 wall_velocity = Vec3::Zero();
    double gap = 0.0;
};

/// All that are nearer than `within` [m].
std::vector<Touch> touches(const World& world, double h, double within);

/// The shortest x ≥ 0 of |A x − b|: Lawson & Hanson 1974, Solving Least Squares Problems, chapter 23.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Whether some velocities of spheres and pistons keep all that touches from closing, and even part it with a
/// ten-thousandth of a diameter in a step, none of them many times as fast as the walls that move as prescribed: the
/// least ones that do (ibid.). A sphere that fits exactly between two walls that stand still has none: rigid impulses
/// may be anything there.
bool has_room(const World& world, double h);

} // namespace talus::test
