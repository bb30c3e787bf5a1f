// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace talus
{

/// Makes sure that a file that a scene names can be read.
/// @param kind in the sentence about what is no file: "an STL file"
/// @throws InputError where it is missing, no file, larger than 1 GiB or empty, or cannot be opened
void require_file(const std::filesystem::path& path, const std::string& kind);

/// The bytes of a file that a scene names, on the conditions of require_file.
std::string read_bytes(const std::filesystem::path& path, const std::string& kind);

} // namespace talus
