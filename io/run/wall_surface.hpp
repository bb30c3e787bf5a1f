// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/wall.hpp"
#include "io/scene/stl.hpp"

namespace talus
{

/// Triangles that show a wall: round shapes in 64 segments, a plane as a square as wide as the widest finite extent of
/// the world, round the world's centre.
TriangleSoup wall_surface(const Shape& shape, const Box& world);

} // namespace talus
