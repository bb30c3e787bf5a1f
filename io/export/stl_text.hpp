// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/scene/stl.hpp"

#include <string>

class vtkPolyData;

namespace talus
{

/// Triangles as ASCII STL; those without area are left out.
std::string stl_text(const TriangleSoup& soup);

/// The triangles of a frame of walls.
std::string stl_text(vtkPolyData& walls);

} // namespace talus
