// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkPolyData.h>

#include <string>

namespace talus
{

/// A frame as the bytes of a .vtp file that any reader of VTK XML knows: zlib in base64, and a cell for each sphere.
/// @throws OutputError where VTK fails
std::string plain_vtp(vtkPolyData& frame);

} // namespace talus
