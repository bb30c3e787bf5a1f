// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/carried.hpp"
#include "core/candidates/neighbor_search.hpp"
#include "core/candidates/tiles.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// A listed sphere and wall: patches [first, first + patches) of the wall lie near, and there are as many slots for
/// what its contacts carry, the first `carried` of them in use.
struct WallPair {
    std::int32_t sphere = 0;
    std::int32_t wall = 0;
    std::uint32_t first = 0;
    std::uint32_t patches = 0;
    std::uint32_t carried = 0;
};

/// Who may touch whom (a Verlet list), kept until a sphere leaves its listed box.
///
/// Everything is stored by tile: a tile owns the pairs in which one of its spheres comes first, in the order in which
/// they are swept, and the walls near its spheres. The place of a pair is its *slot*; a wall pair has a slot for each
/// of its patches.
struct CandidateList {
    // Written by update_candidates (candidate_search.hpp):
    std::vector<Box> listed_box; ///< by sphere: as long as it stays inside, its list is complete; empty: not listed yet
    std::vector<Pose> listed_pose; ///< by wall: its list is complete as long as it moves no further than its skin
    Box listed_around;             ///< box round all listed boxes

    // Written by lay_down:
    Tiles tiles;
    std::vector<IndexPair> pairs;
    std::vector<std::uint32_t> pairs_of_tile = {0}; ///< first pair of each tile; tiles + 1
    std::vector<WallPair> wall_pairs;
    std::vector<std::uint32_t> wall_pairs_of_tile = {0}; ///< first wall pair of each tile; tiles + 1
    std::vector<std::uint32_t> wall_slots_of_tile = {0}; ///< first wall slot of each tile; tiles + 1
    std::vector<std::int32_t> patches;                   ///< by wall slot

    std::size_t size() const { return pairs.size() + wall_pairs.size(); }
    void persist(Archive& archive);
};

inline constexpr std::int32_t not_listed = -1;

/// A pair of spheres, a < b.
struct PairEntry {
    IndexPair pair;
    std::int32_t old = not_listed; ///< its slot in the old list
    bool opposite = false;         ///< the two spheres have changed places since
};

/// A sphere and a wall near it.
struct WallEntry {
    std::int32_t sphere, wall;
    std::uint32_t first, patches;  ///< in the entries' own patch array
    std::int32_t old = not_listed; ///< index in the old list
};

/// A candidate list as it was found.
struct CandidateEntries {
    std::vector<PairEntry> pairs; ///< in the order of their spheres
    std::vector<WallEntry> walls; ///< in no particular order
    std::vector<std::int32_t> patches;
};

/// Lays the list down by tile, in the order in which it is swept; what is carried moves with its pairs.
void lay_down(
    CandidateList& list, Carried& carried, const CandidateEntries& entries, const State& state, const Model& model);

/// Spheres are gone: sphere i is now new_index[i], or gone where that is negative; the others keep their order. The
/// list stays as it is laid down but for what they were part of. (In candidate_removal.cpp.)
void remove_candidates(CandidateList& list, Carried& carried, const std::vector<std::int32_t>& new_index);

} // namespace talus
