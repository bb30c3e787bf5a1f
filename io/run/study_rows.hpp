// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace talus
{

/// What one run of a study found: one setting, from the state of one seed.
struct StudyRow {
    std::string setting; ///< how the study calls it
    std::int64_t seed = 0;
    std::string status = "done"; ///< or a sentence on why it failed
    double cpu = 0.0;            ///< of the steps, for a simulated second [s]
    double updates = 0.0;        ///< contacts × sweeps, for a simulated second
    double memory = 0.0;         ///< the most it had [B]
    std::vector<Measurement> findings = {};
    std::vector<double> profile =
        {}; ///< mean support by walls and through cuts, by the weight of the spheres at the start
};

/// A row as one line of JSON, without its end; what is not a number is null.
std::string row_text(const StudyRow& row);

/// Reads a line back.
/// @throws InputError where it is none
StudyRow read_row(const std::string& line);

/// Reads all rows of a file; a last line without its end was cut off and does not count. No rows where there is no
/// file.
/// @throws InputError
std::vector<StudyRow> read_rows(const std::filesystem::path& path);

} // namespace talus
