// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/supply/mixture.hpp"
#include "core/world/model.hpp"

#include <vector>

namespace talus
{

/// A sphere of a packing.
struct PackedSphere {
    Vec3 center;
    double radius;
    int material = 0;
};

/// A jittered lattice, filled layer by layer from below (against gravity) until `count` spheres are placed, the region
/// is full, or ten million places and ten for each sphere were in vain: a cubic lattice with `spacing` times the
/// largest diameter between its points, each sphere moved at random within the room that the spacing leaves, so that
/// nothing overlaps. Cubic, and not the dense lattices, because it collapses when it falls: a close-packed one stays a
/// crystal. Places where a sphere would touch a wall that stands at time 0 are left out; the sphere goes to the next,
/// so that sizes and species come as often as they are drawn.
std::vector<PackedSphere> lattice_packing(const Region& region, const Mixture& mixture, std::int64_t count,
    double spacing, const std::vector<PackedSphere>& others, const Model& model, Random& random);

/// Spheres at random places without overlap; gives up on one after 2000 tries, so it may return fewer than asked for.
/// @param others already there, kept clear of
std::vector<PackedSphere> random_packing(const Region& region, const Mixture& mixture, std::int64_t count,
    const std::vector<PackedSphere>& others, const Model& model, Random& random);

} // namespace talus
