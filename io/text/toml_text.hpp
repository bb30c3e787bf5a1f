// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/text/field_kind.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

/// The values of a scene as TOML, so that they read back to the same bits.
namespace talus
{

std::string toml_text(double number);
std::string toml_text(bool truth);
std::string toml_text(std::int64_t number);
std::string toml_text(const std::string& text);
std::string toml_text(const Vec3& vector);
std::string toml_text(const scene::NumberOrName& value);
std::string toml_text(const scene::SwitchOrName& value);
std::string toml_text(const std::vector<std::string>& list);
std::string toml_text(const std::vector<scene::Waypoint>& table);
std::string toml_text(const std::vector<scene::LoadRow>& load);

/// As an inline table.
template <Table Described> std::string toml_text(const Described& table)
{
    std::string text;
    for_each_own_key(table, [&](std::string_view name, const auto& field, std::string_view) {
        text += fmt::format("{} {} = {}", text.empty() ? "" : ",", name, toml_text(field));
    });
    return "{" + text + " }";
}

template <Table Described> std::string toml_text(const std::vector<Described>& list)
{
    std::string text;
    for (const Described& element : list) text += (text.empty() ? "" : ", ") + toml_text(element);
    return "[" + text + "]";
}

} // namespace talus
