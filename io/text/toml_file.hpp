// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string_view>

namespace talus
{

/// The tables of a TOML file.
/// @param holds what the file is for, for sentences: "a scene"
/// @throws InputError where there is no such file, it is far too large to be one, or not TOML
toml::table parse_toml_file(const std::filesystem::path& path, std::string_view holds);

} // namespace talus
