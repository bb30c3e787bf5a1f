// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace talus
{

/// A sieve analysis, from fine to coarse.
struct SieveAnalysis {
    std::vector<double> sizes;   ///< of the sieves [m], rising, above 0
    std::vector<double> passing; ///< share of the mass that passes each: from 0, never falling, to 1
};

/// Reads a CSV file with the columns `size_mm` or `size_m` and `passing_percent`, from fine to coarse or the other way.
/// @throws InputError with file and line
SieveAnalysis read_sieves(const std::filesystem::path& path);

} // namespace talus
