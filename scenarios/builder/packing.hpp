// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "scenarios/builder/grain_source.hpp"

#include <vector>

namespace talus
{

/// A sphere of a packing.
struct PackedSphere {
    Vec3 center;
    double radius;
    int material = 0;
};

/// Where the spheres of a packing may lie: wholly inside its region, clear of others and of the walls that stand at
/// time 0, and of each closed wall (a mesh without an open edge, a box with all its faces) on the side on which more of
/// the region lies. So a drum is filled inside, and a shaft that stands in the grains stays empty.
class PackingRoom
{
public:
    /// @param except regions that are kept free
    PackingRoom(const Region& region, std::vector<Region> except, const Model& model);

    /// Whether a sphere may lie there, but for other spheres.
    bool holds(const Vec3& center, double radius) const;

    /// By which way the sphere is to be moved so that it obeys what it breaks most [m]; zero where it may lie there.
    Vec3 way_in(const Vec3& center, double radius) const;

    const Region& region() const { return region_; }
    const Model& model() const { return model_; }

private:
    struct ClosedWall {
        Region inside;
        Pose into;   ///< from the world's frame into the wall's
        bool filled; ///< the region lies inside
    };

    const Region& region_;
    const Model& model_;
    std::vector<Region> except_;
    std::vector<PlacedWall> walls_;
    std::vector<ClosedWall> closed_;

    bool on_right_side(const Vec3& x) const;
};

/// A jittered lattice, filled layer by layer from below (against gravity) until no more spheres are wanted, the region
/// is full, or ten million places and ten for each sphere were in vain: a cubic lattice with `spacing` times the
/// largest diameter between its points, each sphere moved at random within the room that the spacing leaves, so that
/// nothing overlaps. Cubic, and not the dense lattices, because it collapses when it falls: a close-packed one stays a
/// crystal. A sphere without room at one place goes to the next, so that sizes and species come as often as they are
/// drawn.
/// @param others already there, kept clear of
std::vector<PackedSphere> lattice_packing(const PackingRoom& room, GrainSource& grains, double spacing,
    const std::vector<PackedSphere>& others, Random& random);

/// Spheres at random places without overlap; gives up on one after 2000 tries, so it may return fewer than asked for.
std::vector<PackedSphere> random_packing(
    const PackingRoom& room, GrainSource& grains, const std::vector<PackedSphere>& others, Random& random);

/// Spheres at random places that overlap, and are then pushed apart and into the room, overlap by overlap, until none
/// is left: a fill of any sizes up to 0.6 of the room. What still overlaps after 4000 sweeps is left out, so it may
/// return fewer than asked for.
std::vector<PackedSphere> dense_packing(
    const PackingRoom& room, GrainSource& grains, const std::vector<PackedSphere>& others, Random& random);

} // namespace talus
