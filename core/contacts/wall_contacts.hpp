// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/candidate_list.hpp"
#include "core/world/placed_wall.hpp"

#include <vector>

namespace talus
{

/// Normals that differ more than this (cosine) belong to different contacts.
inline constexpr double same_contact = 0.7;

/// Of the nearest points of patches that a ball of this radius meets, keeps those where it touches the wall: the local
/// minima of the distance. Where patches join, the nearest point of one that lies on a nearer one is no contact, and a
/// point shared by several is one contact, so an edge or a vertex carries one contact's worth of force.
void keep_local_minima(const PlacedWall& wall, double radius, std::vector<WallPoint>& near);

/// Brings what a wall pair carries into the order of its new contacts: each takes the impulse of the old contact whose
/// normal is nearest to its own, the nearest pairs first; the rest is dropped.
void match_carried(Carried& carried, WallPair& pair, const std::vector<WallPoint>& points);

} // namespace talus
