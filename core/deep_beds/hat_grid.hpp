// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace talus
{

/// A cell of the lattice, or a node: the lower corner of the cell of its number.
using LatticeIndex = std::array<std::int32_t, 3>;

/// The eight corners of a cell: 0 or 1 along each axis.
inline std::array<int, 3> corner_of_cell(int number)
{
    return {number & 1, number >> 1 & 1, number >> 2 & 1};
}

/// Where a point lies among the nodes.
struct HatPlace {
    LatticeIndex cell = {};
    Vec3 fraction = Vec3::Zero(); ///< of the cell's edges, in [0, 1]

    /// φ of the node at this corner of the cell.
    double hat(const std::array<int, 3>& corner) const
    {
        double product = 1.0;
        for (int d = 0; d < 3; ++d) product *= corner[d] ? fraction[d] : 1.0 - fraction[d];
        return product;
    }
};

/// A cubic lattice of nodes in a box, each with its hat function φ: 1 at the node, 0 at all others, trilinear between.
/// The hats add up to 1 everywhere.
class HatGrid
{
public:
    /// @param spacing of the nodes [m]; doubled until the box has few enough of them to be counted through
    /// @param around all points that will be asked for; @param corner a node
    HatGrid(double spacing, const Box& around, const Vec3& corner = Vec3::Zero());

    HatPlace place_of(const Vec3& x) const;

    /// Nodes are numbered from 0 to node_count() − 1. A cell has the number of its lowest node.
    std::size_t node_count() const;
    std::size_t number(const LatticeIndex& node) const;
    LatticeIndex node(std::size_t number) const;

private:
    Vec3 origin_;
    double spacing_;
    LatticeIndex low_ = {};    ///< the first node along each axis …
    LatticeIndex extent_ = {}; ///< … and how many there are
};

} // namespace talus
