// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{

/// A case of a sweep: one run, as the folder of the sweep has it in `sweep.json` and a row of `cases.csv`.
struct SweepCase {
    std::filesystem::path scene;        ///< file
    std::vector<std::string> overrides; ///< key=value
    std::filesystem::path folder;       ///< of its run
    std::string identity;               ///< settings, and files with their checksums, a line each
    int threads = 1;
    bool report = true; ///< whether it ends with its page
};

/// The case of that number.
/// @param version of Talus; a sweep is gone on with by the version that began it
/// @throws InputError where the folder holds no sweep, the sweep has no such case, another version began it, or its
/// scene or a file that this names is not what it was
SweepCase read_sweep_case(const std::filesystem::path& sweep, int number, const std::string& version);

/// The `status` of a run's summary.json; empty where there is none, or none that is whole.
std::string status_of_run(const std::filesystem::path& folder);

/// Notes of which case a folder holds the run, or the refusal, in its `case.txt`. @throws OutputError
void keep_identity(const std::filesystem::path& folder, const std::string& identity);

/// What was noted; empty where nothing was.
std::string kept_identity(const std::filesystem::path& folder);

/// Keeps why the scene of a case was refused, in `refused.txt` of its folder, which is made.
/// @throws OutputError
void keep_refusal(const std::filesystem::path& folder, const std::string& sentence);

/// Why the scene of a case was refused; empty where it was not.
std::string kept_refusal(const std::filesystem::path& folder);

/// Takes that away. @throws OutputError
void forget_refusal(const std::filesystem::path& folder);

} // namespace talus
