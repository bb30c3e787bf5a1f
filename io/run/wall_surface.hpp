// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/wall.hpp"
#include "io/scene/stl.hpp"

namespace talus
{

/// Triangles that show a wall: round shapes in 64 segments, a plane as a square twice as wide as what there is to be
/// seen, round its centre.
/// @param contents what there is to be seen
TriangleSoup wall_surface(const Shape& shape, const Box& contents);

} // namespace talus
