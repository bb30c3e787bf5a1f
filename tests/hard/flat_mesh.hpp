// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/wall.hpp"

#include <string>

namespace talus::test
{

/// A strip of the plane z = 0, along x round the origin, cut into triangles: squares that stand at an angle to the
/// strip, each cut along one diagonal or the other.
struct FlatMesh {
    double length = 0.0;              ///< [m]
    double width = 0.0;               ///< [m]
    double cell = 0.0;                ///< edge of a square [m]
    double angle = 0.0;               ///< of the squares to the strip [rad]
    std::string diagonals = "rising"; ///< or falling, or mixed
    double jitter = 0.0;              ///< corners are moved within the plane by up to this share of a cell
};

Mesh make_flat_mesh(const FlatMesh& strip);

/// The mesh turned about the origin.
Mesh turned(const Mesh& mesh, const Eigen::Matrix3d& turn);

/// The mesh as an STL file holds it: coordinates of 32 bits.
Mesh as_in_stl(const Mesh& mesh);

std::size_t edge_count(const Mesh& mesh);

} // namespace talus::test
