// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/recorded_run.hpp"

#include <string>

namespace talus
{

/// A frame of spheres as CSV: a row for each, names with units as in metrics.csv, materials by name, the time in every
/// row.
std::string csv_spheres(vtkPolyData& frame, double time, const RecordedRun& run);

/// A frame of contacts in the same way, with the ends of their lines, and walls by name.
std::string csv_contacts(vtkPolyData& frame, double time, const RecordedRun& run);

} // namespace talus
