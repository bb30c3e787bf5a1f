// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// What the readers of all files share.
namespace talus
{

/// Of a file that a scene names [B].
inline constexpr std::uintmax_t largest_input_file = std::uintmax_t{1} << 30;

/// Makes sure that a file can be read.
/// @param kind in sentences: "an STL file"
/// @throws InputError where it is missing, no file, larger than `largest` bytes or empty, or cannot be opened
void require_file(
    const std::filesystem::path& path, const std::string& kind, std::uintmax_t largest = largest_input_file);

/// The bytes of a file, on the conditions of require_file.
std::string read_bytes(
    const std::filesystem::path& path, const std::string& kind, std::uintmax_t largest = largest_input_file);

/// CRC-32 (that of zlib and PNG) of some bytes.
std::uint32_t checksum(std::string_view bytes);

/// The finite number that a whole text is, perhaps with a + before it; nothing where it is none.
std::optional<double> finite_number(std::string_view text);

} // namespace talus
