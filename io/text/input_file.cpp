// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/input_file.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace talus
{

void require_file(const std::filesystem::path& path, const std::string& kind, std::uintmax_t largest)
{
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
    if (!std::filesystem::is_regular_file(path, error))
        throw InputError(fmt::format("{}: not {}", path.string(), kind));
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > largest)
        throw InputError(fmt::format("{}: {} has at most {} bytes, this one {}", path.string(), kind, largest, size));
    if (size == 0) throw InputError(fmt::format("{}: the file is empty", path.string()));
    if (error || !std::ifstream(path)) throw InputError(fmt::format("{}: the file cannot be read", path.string()));
}

std::string read_bytes(const std::filesystem::path& path, const std::string& kind, std::uintmax_t largest)
{
    require_file(path, kind, largest);
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::uint32_t checksum(std::string_view bytes)
{
    const auto begin = ::crc32(0, nullptr, 0);
    return static_cast<std::uint32_t>(
        ::crc32_z(begin, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::optional<double> finite_number(std::string_view text)
{
    if (text.starts_with('+')) text.remove_prefix(1); // which from_chars does not take
    const char* const text_end = text.data() + text.size();
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text_end, number);
    if (error != std::errc() || end != text_end || !std::isfinite(number)) return std::nullopt;
    return number;
}

} // namespace talus
