// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace talus
{

/// The bytes of a file that a scene names; at most 1 GiB.
/// @param kind in the sentence about what is no file: "an STL file"
/// @throws InputError where it is missing, empty, too large or no file
std::string read_bytes(const std::filesystem::path& path, const std::string& kind);

} // namespace talus
