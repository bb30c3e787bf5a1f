// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/candidate_list.hpp"
#include "core/world/placed_wall.hpp"

#include <vector>

namespace talus
{

/// The places where a ball of this radius round x touches a wall: the local minima of the distance over the listed
/// patches. Where patches join, the nearest point of one that lies on a nearer one is no contact, and a point shared by
/// several is one contact, so an edge or a vertex carries one contact's worth of force.
void find_wall_points(const PlacedWall& wall, const std::int32_t* patches, std::size_t count, const Vec3& x,
    double radius, std::vector<WallPoint>& points);

/// Brings what a wall pair carries into the order of its new contacts: each takes the impulse of the old contact whose
/// normal is nearest to its own, the nearest pairs first; the rest is dropped.
void match_carried(Carried& carried, WallPair& pair, const std::vector<WallPoint>& points);

} // namespace talus
