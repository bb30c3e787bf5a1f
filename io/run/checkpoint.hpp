// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace talus
{

/// A checkpoint as read back from a run's folder.
struct Checkpoint {
    std::string state; ///< as it was written
    std::filesystem::path path;
    std::string newer_is_broken; ///< a sentence on why the newer one could not be used; empty where it was
};

/// Writes a checkpoint, whole or not at all: checkpoint.latest, and what had that name becomes checkpoint.previous.
/// io/README.md has the format.
/// @param version of Talus
/// @throws OutputError; the checkpoints there are then as they were
void write_checkpoint(const std::filesystem::path& folder, const std::string& version, const std::string& state);

/// Reads the newest checkpoint that is whole.
/// @param version of Talus; a state is only put back by the version that stored it
/// @throws InputError where there is none, or none that can be used, with the reason
Checkpoint read_checkpoint(const std::filesystem::path& folder, const std::string& version);

/// The same under a name of its own, alone. @throws OutputError
void write_checkpoint_file(const std::filesystem::path& file, const std::string& version, const std::string& state);

/// @throws InputError where the file cannot be used
Checkpoint read_checkpoint_file(const std::filesystem::path& file, const std::string& version);

} // namespace talus
