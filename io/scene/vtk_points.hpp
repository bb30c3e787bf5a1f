// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

namespace talus
{

/// Reads the points of a VTK XML file with their arrays, .vtp or .vtu by the file's extension. VTK prints nothing.
/// @throws InputError with what VTK complains of
vtkSmartPointer<vtkPointSet> read_points(const std::filesystem::path& path);

} // namespace talus
