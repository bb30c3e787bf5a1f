// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/recorded_run.hpp"

#include <string>
#include <vector>

namespace talus
{

/// lammps_dump: what LAMMPS writes and OVITO reads. csv: for spreadsheets and scripts. vtp: VTK without LZ4, a cell for
/// each sphere, for readers that know no more.
enum class FrameFormat { lammps_dump, csv, vtp };

/// What an export has left to say, a sentence each.
using ExportNotes = std::vector<std::string>;

/// Writes the frames of a run, its contacts and, but for csv, its walls into a folder of their own.
/// @throws InputError where a frame is missing or damaged, or the folder is not free; OutputError
ExportNotes export_frames(const RecordedRun& run, FrameFormat format, const std::filesystem::path& folder, bool force);

} // namespace talus
