// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace talus
{

/// A checkpoint as read back from a run's folder.
struct Checkpoint {
    std::string state; ///< as it was written
    std::filesystem::path path;
    std::string newer_is_broken; ///< a sentence on why the newer one could not be used; empty where it was
};

/// What a checkpoint's file begins with.
inline constexpr std::string_view checkpoint_mark = "TALUSCHK";

/// A state as bytes that say what they are, with a checksum. io/README.md has the format.
/// @param version of Talus; a state is only put back by the version that stored it
std::string checkpoint_bytes(const std::string& version, const std::string& state);

/// The state in such bytes. @throws InputError where they are of something else, of another version, or not whole
std::string state_in(const std::string& bytes, const std::string& version);

/// Writes a checkpoint, whole or not at all: checkpoint.latest, and what had that name becomes checkpoint.previous.
/// @param version of Talus
/// @throws OutputError; the checkpoints there are then as they were
void write_checkpoint(const std::filesystem::path& folder, const std::string& version, const std::string& state);

/// Reads the newest checkpoint that is whole.
/// @throws InputError where there is none, or none that can be used, with the reason
Checkpoint read_checkpoint(const std::filesystem::path& folder, const std::string& version);

/// The same under a name of its own, alone. @throws OutputError
void write_checkpoint_file(const std::filesystem::path& file, const std::string& version, const std::string& state);

/// @throws InputError where the file cannot be used
Checkpoint read_checkpoint_file(const std::filesystem::path& file, const std::string& version);

} // namespace talus
