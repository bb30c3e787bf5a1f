// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact.hpp"
#include "core/candidates/neighbor_search.hpp"
#include "core/candidates/tiles.hpp"
#include "core/world/model.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// What contacts hand on from one step to the next, by slot: a slot is a listed pair, or one of those of a listed wall.
struct CarriedImpulses {
    std::vector<Vec3> impulse;         ///< λ [N s], zero where nothing is carried
    std::vector<Vec3> rolling_impulse; ///< [N m s]; empty unless the scene has rolling resistance
    /// 0: in the step before it neither overlapped nor, unless open, had an impulse; 1 did, and so did what
    /// has more, which has been pressed (press_count.hpp).
    std::vector<std::uint8_t> touched;

    CarriedImpulses() = default;
    CarriedImpulses(std::size_t slots, bool with_rolling);
    void persist(Archive& archive) { archive(impulse, rolling_impulse, touched); }
    void clear(std::size_t slot);
    void scale(double factor); ///< all of them
    void copy(std::size_t slot, const CarriedImpulses& from, std::size_t from_slot, bool opposite = false);
};

/// A listed sphere and wall: patches [first, first + patches) of the wall lie near, and there are as many slots for
/// what its contacts carry, the first `carried` of them in use.
struct WallPair {
    std::int32_t sphere = 0;
    std::int32_t wall = 0;
    std::uint32_t first = 0;
    std::uint32_t patches = 0;
    std::uint32_t carried = 0;
};

/// Contacts of one step. Those of tile t fill count[t] entries of each array from the tile's first slot on.
struct ContactArrays {
    std::vector<Contact> contact;
    std::vector<ContactTerms> terms;
    std::vector<RollingRow> rolling; ///< empty unless the scene has rolling resistance
    std::vector<WallRow> wall;       ///< empty unless walls move, and between spheres
    std::vector<ContactGeometry> geometry;
    std::vector<std::uint32_t> count; ///< by tile

    void resize(std::size_t slots, std::size_t tiles, bool with_rolling, bool with_moving_walls = false);
};

/// Who may touch whom, who does, and with what impulse: all that a step needs beyond the spheres themselves.
///
/// The list is kept until a sphere leaves its listed box (candidate_search.hpp); impulses stay in place meanwhile.
/// Everything is stored by tile: a tile owns the pairs in which one of its spheres comes first, in the order in which
/// they are swept, and the walls near its spheres.
struct ContactNetwork {
    std::vector<Box> listed_box; ///< by sphere: as long as it stays inside, its list is complete; empty: not listed yet
    std::vector<Pose> listed_pose; ///< by wall: likewise, as long as it moves no further than its skin
    Box listed_around;             ///< box round all listed boxes
    Tiles tiles;

    std::vector<IndexPair> pairs;
    std::vector<std::uint32_t> pairs_of_tile = {0}; ///< first pair of each tile; tiles + 1
    std::vector<std::uint32_t> pair_of_sphere; ///< the pairs by their first sphere: those of sphere i are entries …
    std::vector<std::uint32_t> first_pair;     ///< … first_pair[i] …
    std::vector<std::uint32_t> pair_count;     ///< … to first_pair[i] + pair_count[i] − 1
    CarriedImpulses pair_carried;

    std::vector<WallPair> wall_pairs;
    std::vector<std::uint32_t> wall_pairs_of_tile = {0};
    std::vector<std::uint32_t> first_wall_pair; ///< by sphere
    std::vector<std::uint32_t> wall_pair_count; ///< by sphere
    std::vector<std::uint32_t> wall_slots_of_tile = {0};
    std::vector<std::int32_t> patches;     ///< by slot
    CarriedImpulses wall_carried;          ///< by slot
    std::vector<Vec3> wall_carried_normal; ///< by slot: the normal by which the next step knows a wall contact again
    /// How long the impulses, carried and of the contacts below, have acted [s]; infinite before the first step, when
    /// none has.
    double impulse_step = infinity;

    ContactArrays sphere_contacts; ///< tile t from pairs_of_tile[t] on
    ContactArrays wall_contacts;   ///< tile t from wall_slots_of_tile[t] on, without those with pistons …
    ContactArrays piston_contacts; ///< … which one thread takes after the tiles: count has one entry
    std::vector<Vec3> piston_arms; ///< from the centre of the piston to where the contact is [m]

    /// Makes room for the contacts of a step: as many as there are slots.
    void resize_contacts(const ModelledPhysics& physics);

    /// All that the next step begins with; the contacts of the last one are not among it.
    void persist(Archive& archive);
};

} // namespace talus
