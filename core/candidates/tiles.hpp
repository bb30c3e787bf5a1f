// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/periodicity.hpp"
#include "core/candidates/carried.hpp"
#include "core/candidates/neighbor_search.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace talus
{

/// Cubes of space, coloured by the parity of their three indices (8 colours). Where they lie does not depend on the
/// spheres, so that whoever has some of these knows the cells of them all.
///
/// A tile owns the pairs whose first sphere lies in its cell. With an edge of at least twice the largest distance along
/// an axis between the places of any two that make a pair, two tiles of one colour share no sphere: threads may take
/// them at the same time.
class TileGrid
{
public:
    /// A cell begins at `corner`. Along a periodic axis the period is divided into an even number of equal cells at
    /// least as long as `edge`, so that neighbours across its border differ in parity, or is one cell.
    TileGrid(double edge, const Periodicity& periodicity, const Vec3& corner);

    /// The number of the cell that holds this place or an image of it. Those of one colour follow each other. Along an
    /// axis that is not periodic the outermost of 2^20 cells have no end.
    std::uint64_t cell(const Vec3& place) const;

    static std::size_t color(std::uint64_t cell) { return static_cast<std::size_t>(cell >> (3 * bits)); }

private:
    static constexpr int bits = 20; ///< of an index along one axis

    struct Axis {
        double origin, edge;
        std::int64_t period = 0; ///< in cells; 0: not periodic

        std::int64_t index(double x) const;
    };
    std::array<Axis, 3> axes_;
};

/// The pairs of spheres that a tile owns, in the order in which they are swept. The place of a pair is its *slot*.
struct Tile {
    std::vector<IndexPair> pairs;
    CarriedImpulses carried; ///< by slot

    void persist(Archive& archive) { archive(pairs, carried); }
};

/// The tiles of the cells in which something is listed.
struct Tiles {
    static constexpr std::size_t colors = 8;

    std::vector<std::uint64_t> cells; ///< by tile, ascending
    std::vector<Tile> tiles;
    std::array<std::uint32_t, colors + 1> color_first{}; ///< tiles of colour c are [color_first[c], color_first[c + 1])

    std::size_t count() const { return tiles.size(); }
    /// The tile of a cell, or −1.
    std::int32_t of_cell(std::uint64_t cell) const;
    /// Makes tiles for these cells where one of them has none. Other tiles that have become empty go then.
    void open(std::vector<std::uint64_t> needed);
    std::size_t pair_count() const;
    void persist(Archive& archive) { archive(cells, tiles, color_first); }
};

/// What belongs to which tile, by place in the list from which it was made.
class SortedByTile
{
public:
    /// @param tile by place; −1 belongs to none
    SortedByTile(const std::vector<std::int32_t>& tile, std::size_t tiles);

    /// The places of what belongs to a tile, ascending.
    std::vector<std::uint32_t>::const_iterator begin(std::size_t tile) const { return places_.begin() + first_[tile]; }
    std::vector<std::uint32_t>::const_iterator end(std::size_t tile) const { return begin(tile + 1); }
    std::size_t count(std::size_t tile) const { return first_[tile + 1] - first_[tile]; }
    const std::vector<std::uint32_t>& first() const { return first_; }
    const std::vector<std::uint32_t>& places() const { return places_; }

private:
    std::vector<std::uint32_t> first_, places_;
};

} // namespace talus
