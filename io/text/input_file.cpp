// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/input_file.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace talus
{

namespace
{

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;

} // namespace

void require_file(const std::filesystem::path& path, const std::string& kind)
{
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
    if (!std::filesystem::is_regular_file(path, error))
        throw InputError(fmt::format("{}: not {}", path.string(), kind));
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > largest_file)
        throw InputError(fmt::format("{}: larger than the {} bytes that are read", path.string(), largest_file));
    if (size == 0) throw InputError(fmt::format("{}: the file is empty", path.string()));
    if (!std::ifstream(path)) throw InputError(fmt::format("{}: the file cannot be read", path.string()));
}

std::string read_bytes(const std::filesystem::path& path, const std::string& kind)
{
    require_file(path, kind);
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace talus
