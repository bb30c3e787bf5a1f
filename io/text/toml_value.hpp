// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// What the scene's `describe` says of a key, as far as its value and the sentences about it go.
struct Key {
    std::string_view name;
    const scene::Allowed& allowed;
    std::string_view unit;
};

/// "file:line:column" of what was parsed, or "--set key=value" where it came from the command line.
std::string place_in(const toml::source_region& source);

/// What every value from the command line has as the name of its source.
inline constexpr std::string_view override_prefix = "--set ";

/// What is wrong with the TOML, on one line.
std::string describe_error(const toml::parse_error& error);

/// The tables of a TOML text.
/// @param source what it comes from, for sentences
/// @throws InputError where it is not TOML
toml::table parse_toml(std::string_view text, const std::string& source);

/// The tables of a TOML file.
/// @param kind in sentences: "a scene file"
/// @throws InputError where there is no such file, it is empty or above 1 MiB, or not TOML
toml::table parse_toml_file(const std::filesystem::path& path, const std::string& kind);

/// A value as a sentence names it: "the string 'high'", "-1.5", "a table".
std::string describe_value(const toml::node& node);

/// What a key's value must be, for sentences: "a number above 0 [s] or inf", "three numbers [m]".
std::string expected_value(const Key& key, const bool& field);
std::string expected_value(const Key& key, const std::vector<scene::Waypoint>& field);
std::string expected_value(const Key& key, const std::vector<scene::LoadRow>& field);
std::string expected_value(const Key& key, const std::int64_t& field);
std::string expected_value(const Key& key, const double& field);
std::string expected_value(const Key& key, const std::string& field);
std::string expected_value(const Key& key, const Vec3& field);
std::string expected_value(const Key& key, const scene::NumberOrName& field);
std::string expected_value(const Key& key, const scene::SwitchOrName& field);
std::string expected_value(const Key& key, const std::vector<std::string>& field);

/// Reads one value and checks that it is allowed.
/// @throws InputError "place: 'key' must be …, not …"
void read_value(const toml::node& node, const Key& key, bool& field);
void read_value(const toml::node& node, const Key& key, std::int64_t& field);
void read_value(const toml::node& node, const Key& key, double& field);
void read_value(const toml::node& node, const Key& key, std::string& field);
void read_value(const toml::node& node, const Key& key, Vec3& field);
void read_value(const toml::node& node, const Key& key, scene::NumberOrName& field);
void read_value(const toml::node& node, const Key& key, scene::SwitchOrName& field);
void read_value(const toml::node& node, const Key& key, std::vector<std::string>& field);
void read_value(const toml::node& node, const Key& key, std::vector<scene::Waypoint>& field);
void read_value(const toml::node& node, const Key& key, std::vector<scene::LoadRow>& field);

/// @throws InputError "place: 'key' must be `expected`, not …"
[[noreturn]] void refuse_value(const toml::node& node, std::string_view key, std::string_view expected);

} // namespace talus
