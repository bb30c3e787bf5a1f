// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/periodicity.hpp"
#include "core/base/vector.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace talus
{

/// Cubes of space that hold the spheres, coloured by the parity of their three indices (8 colours).
///
/// A tile owns the contacts of its spheres with spheres of higher storage index. With an edge of at least twice the
/// largest distance of centres (along one axis) in any listed pair, two tiles of one colour share no sphere, so threads
/// may take them at the same time, and the result does not depend on how many threads there are: the order of the
/// tiles, and of the spheres in them, follows from the positions alone.
struct Tiles {
    static constexpr std::size_t colors = 8;

    std::vector<std::int32_t> spheres;                   ///< storage indices, tile after tile, ascending within a tile
    std::vector<std::uint32_t> first = {0};              ///< where each tile begins in `spheres`; size count() + 1
    std::array<std::uint32_t, colors + 1> color_first{}; ///< tiles of colour c are [color_first[c], color_first[c + 1])

    std::size_t count() const { return first.size() - 1; }
    void persist(Archive& archive) { archive(spheres, first, color_first); }
};

/// Sorts the spheres at these places into tiles; empty tiles are left out. Along a periodic axis the cell is divided
/// into an even number of equal tiles at least as long as `edge`, so that neighbours across its border differ in
/// parity, or is one tile. Along the others a tile begins at `corner`.
Tiles make_tiles(const std::vector<Vec3>& position, double edge, const Periodicity& periodicity = {},
    const Vec3& corner = Vec3::Zero());

} // namespace talus
