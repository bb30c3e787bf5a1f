// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// What the spheres did to a wall in a step.
struct WallLoad {
    Vec3 impulse = Vec3::Zero(); ///< [N s]
    Vec3 torque = Vec3::Zero();  ///< angular impulse about the origin, rolling resistance included [N m s]
};

/// The load on each of `walls` walls, from the solved contacts. An impulse acts at x − r n, where the sphere meets the
/// wall's own velocity too, so that torque times rate of turning is the power that a wall puts in.
/// @pre the spheres have not been moved since detection
std::vector<WallLoad> wall_loads(const ContactNetwork& network, const State& state, std::size_t walls);

} // namespace talus
