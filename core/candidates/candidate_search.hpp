// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/candidate_list.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"

#include <algorithm>

namespace talus
{

/// Open gaps up to this share of the smallest diameter are contacts of the problem even at rest.
inline constexpr double open_contact_reach = 0.01;

/// A pair is also a contact when it would close within this many steps.
inline constexpr double closing_horizon = 1.5;

/// Up to which gap there is a contact, however it moves, in smallest diameters: what attracts does so up to its range.
inline double contact_reach(const Model& model)
{
    return std::max(open_contact_reach, model.attraction_range / model.min_diameter);
}

/// Brings the candidate list up to date (a Verlet list with boxes for a skin; Verlet 1967).
///
/// Each sphere has a listed box: the room that it takes, grown by a skin and drawn out along its way for the next
/// steps, so that a grain in free fall is not searched for again at once. The list holds every pair of boxes that meet.
/// As long as each sphere, with the reach of its contacts, stays inside its box, the list is complete. The spheres that
/// have left theirs, with those about to, get a new box and are searched for again, alone if they are few; impulses
/// stay with their pairs.
///
/// Walls that move have a skin of their own: when one has moved further, it alone is searched for anew by all spheres.
///
/// @param h of the step [s]; @param walls as they stand when it begins
/// Returns how many spheres were searched for.
std::size_t update_candidates(CandidateList& list, Carried& carried, const State& state, const Model& model, double h,
    const std::vector<PlacedWall>& walls);

/// Follows a new storage order of the spheres: sphere i is now new_index[i].
/// @param state already renumbered
void renumber_candidates(CandidateList& list, Carried& carried, const State& state, const Model& model,
    const std::vector<std::int32_t>& new_index);

} // namespace talus
