// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "io/text/field_kind.hpp"
#include "io/text/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace talus
{

namespace
{

/// A key with its value on a line of its own, and its unit where it has one.
void write_line(std::string& text, std::string_view name, const auto& field, std::string_view unit)
{
    text += fmt::format("{} = {}{}\n", name, toml_text(field), unit.empty() ? "" : fmt::format("  # {}", unit));
}

template <Table Described> void write_table(std::string& text, const std::string& header, const Described& table)
{
    text += fmt::format("\n{}\n", header);
    for_each_own_key(table,
        [&](std::string_view name, const auto& field, std::string_view unit) { write_line(text, name, field, unit); });
}

/// One key of the scene itself, with its unit if it is no table.
void write_key(std::string& text, std::string_view name, const auto& field, std::string_view unit)
{
    write_line(text, name, field, unit);
}

template <Table Described>
void write_key(std::string& text, std::string_view name, const Described& table, std::string_view)
{
    write_table(text, fmt::format("[{}]", name), table);
}

template <Table Described>
void write_key(std::string& text, std::string_view name, const std::vector<Described>& list, std::string_view)
{
    for (const Described& element : list) write_table(text, fmt::format("[[{}]]", name), element);
}

void write_key(
    std::string& text, std::string_view name, const std::vector<scene::MaterialTable>& materials, std::string_view)
{
    for (const scene::MaterialTable& material : materials)
        write_table(text, fmt::format("[{}.{}]", name, toml_text(material.name)), material);
}

/// Every key with its value, by its path. Tables within a table of a list are values of one key.
using KeyValues = std::vector<std::pair<std::string, std::string>>;

template <Table Described> void list_keys(KeyValues& list, const std::string& path, const Described& table)
{
    for_each_own_key(table, [&](std::string_view name, const auto& field, std::string_view) {
        list.emplace_back(fmt::format("{}.{}", path, name), toml_text(field));
    });
}

void list_key(KeyValues& list, std::string_view name, const auto& field)
{
    list.emplace_back(name, toml_text(field));
}

template <Table Described> void list_key(KeyValues& list, std::string_view name, const Described& table)
{
    list_keys(list, std::string(name), table);
}

template <Table Described> void list_key(KeyValues& list, std::string_view name, const std::vector<Described>& tables)
{
    list.emplace_back(name, fmt::format("{} tables", tables.size()));
    for (std::size_t k = 0; k < tables.size(); ++k) list_keys(list, fmt::format("{}[{}]", name, k), tables[k]);
}

void list_key(KeyValues& list, std::string_view name, const std::vector<scene::MaterialTable>& materials)
{
    for (const scene::MaterialTable& material : materials)
        list_keys(list, fmt::format("{}.{}", name, material.name), material);
}

KeyValues key_values(const scene::Scene& scene)
{
    KeyValues list;
    for_each_own_key(
        scene, [&](std::string_view name, const auto& field, std::string_view) { list_key(list, name, field); });
    return list;
}

} // namespace

std::vector<std::string> changed_keys(const scene::Scene& before, const scene::Scene& after)
{
    const KeyValues old_values = key_values(before), new_values = key_values(after);
    std::vector<std::string> changed;
    for (const auto& [key, value] : new_values)
        if (std::ranges::find(old_values, std::pair(key, value)) == old_values.end()) changed.push_back(key);
    for (const auto& [key, value] : old_values)
        if (std::ranges::find(new_values, key, &KeyValues::value_type::first) == new_values.end())
            changed.push_back(key);
    return changed;
}

std::string resolved_scene(const scene::Scene& scene)
{
    std::string text;
    for_each_own_key(scene,
        [&](std::string_view name, const auto& field, std::string_view unit) { write_key(text, name, field, unit); });
    return text;
}

} // namespace talus
