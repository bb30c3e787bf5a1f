// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

class vtkPolyData;
template <class T> class vtkSmartPointer;

namespace talus
{

/// A frame that a run has listed.
struct RecordedFrame {
    double time = 0.0; ///< [s]
    std::filesystem::path file;
};

/// What a run has written so far: one that is over, killed, or still going on.
struct RecordedRun {
    std::string title;
    std::vector<std::string> materials; ///< by index, as the frames have it
    std::vector<std::string> walls;     ///< by index
    std::vector<RecordedFrame> particles, contacts, still_walls, moving_walls;
    std::filesystem::path folder;
    std::array<bool, 3> periodic{};              ///< along x, y, z, from
    Vec3 min = Vec3::Zero(), max = Vec3::Zero(); ///< … to [m]
};

/// @param folder of a run
/// @throws InputError where it is none, or a part of it is damaged
RecordedRun read_run(const std::filesystem::path& folder);

/// The points or lines of a frame with their arrays, as io/README.md lists them.
/// @throws InputError where the file is missing or damaged
vtkSmartPointer<vtkPolyData> read_frame(const RecordedFrame& frame);

} // namespace talus
