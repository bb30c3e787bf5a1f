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
/// Pairs stand in tiles: a tile owns those whose first sphere has its listed box in the tile's cell, by the centre, and
/// the walls near its spheres. A wall pair has a slot for each of its patches.
struct CandidateList {
    std::vector<Box> listed_box; ///< by sphere: as long as it stays inside, its list is complete; empty: not listed yet
    std::vector<Pose> listed_pose; ///< by wall: its list is complete as long as it moves no further than its skin
    Box listed_around;             ///< box round all listed boxes; kept where a wall moves

    double tile_edge = 0.0; ///< no listed box was longer than half of this [m]
    Tiles tiles;
    std::vector<WallPair> wall_pairs;
    std::vector<std::uint32_t> wall_pairs_of_tile = {0}; ///< first wall pair of each tile; tiles + 1
    std::vector<std::int32_t> patches;                   ///< by wall slot

    std::size_t size() const { return tiles.pair_count() + wall_pairs.size(); }
    TileGrid grid(const Model& model) const { return {tile_edge, model.periodicity, model.contents.min}; }
    void persist(Archive& archive);
};

inline constexpr std::int32_t not_listed = -1;

/// Pairs that stand in no tile.
struct LoosePairs {
    std::vector<IndexPair> pairs;
    CarriedImpulses carried; ///< by pair
};

/// A sphere and a wall near it.
struct WallEntry {
    std::int32_t sphere, wall;
    std::uint32_t first, patches;  ///< in the entries' own patch array
    std::int32_t old = not_listed; ///< index in the old list
};

/// Walls near spheres as they were found.
struct WallEntries {
    std::vector<WallEntry> walls; ///< in no particular order
    std::vector<std::int32_t> patches;
};

/// Takes the pairs that have one of these spheres out of their tiles.
LoosePairs take_pairs(Tiles& tiles, const std::vector<std::uint8_t>& is_one, bool with_rolling);

/// Tells the tiles which pairs there are besides those that they have, and which walls there are in all. What was
/// carried goes with its pair.
/// @param found each once, in no particular order
/// @param known what some of these carried
void lay_down(CandidateList& list, Carried& carried, const std::vector<IndexPair>& found, const LoosePairs& known,
    const WallEntries& walls, const Model& model);

/// Spheres are gone: sphere i is now new_index[i], or gone where that is negative; the others keep their order. The
/// list stays as it is laid down but for what they were part of. (In candidate_removal.cpp.)
void remove_candidates(CandidateList& list, Carried& carried, const std::vector<std::int32_t>& new_index);

} // namespace talus
