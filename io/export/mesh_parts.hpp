// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/wall.hpp"

#include <vector>

/// Meshes that are surfaces with a name, for programs that have no triangles.
namespace talus
{

/// A surface once round a coordinate axis, between rings of a mesh's corners.
struct RoundParts {
    std::vector<Shape> shapes; ///< cones and disks; empty where the mesh is not round
    double sag = 0.0;          ///< how far its triangles come up short of them at most [m]
};

/// The mesh as cones and disks: its corners lie on rings round x, y or z, and its triangles join these all the way
/// round, with no chord more than a twentieth of the radius within the circle.
RoundParts round_parts(const Mesh& mesh);

/// A flat plate: corner + s edge_a + t edge_b, s and t in [0, 1].
using Plate = Panels::Rectangle;

/// The mesh as plates, two triangles each, whose angles need not be right; empty where it is not made of such.
std::vector<Plate> plates(const Mesh& mesh);

} // namespace talus
