// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace talus::fuzz
{

/// Writes an input to a file of this name, for readers that want a path, and returns that. There is one folder for all
/// files of this process; it is gone when the process ends in peace.
std::filesystem::path fuzzed_file(const std::string& name, const std::uint8_t* bytes, std::size_t size);

} // namespace talus::fuzz
