// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/toml_file.hpp"

#include "io/text/input_error.hpp"
#include "io/text/toml_value.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace talus
{
namespace
{

/// Far above any scene or study, which holds numbers and names; geometry lies in files of its own.
constexpr std::uintmax_t largest_file = 1 << 20;

std::string read_text(const std::filesystem::path& path, std::string_view holds)
{
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
    if (!std::filesystem::is_regular_file(path, error))
        throw InputError(fmt::format("{}: not a file that holds {}", path.string(), holds));
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > largest_file)
        throw InputError(
            fmt::format("{}: {} file has at most {} bytes, this one {}", path.string(), holds, largest_file, size));
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw InputError(fmt::format("{}: the file cannot be read", path.string()));
    return text;
}

} // namespace

toml::table parse_toml_file(const std::filesystem::path& path, std::string_view holds)
{
    try {
        return toml::parse(read_text(path, holds), path.string());
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}: {}", place_in(error.source()), describe_error(error)));
    }
}

} // namespace talus
