// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/field_kind.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus
{

namespace
{

/// A number that reads back to the same bits, and as a float.
std::string toml_text(double number)
{
    std::string text = fmt::format("{}", number);
    if (std::isfinite(number) && text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string toml_text(bool truth)
{
    return truth ? "true" : "false";
}

std::string toml_text(std::int64_t number)
{
    return fmt::format("{}", number);
}

std::string toml_text(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += fmt::format("\\{}", c);
        else if ((c >= 0 && c < ' ') || c == 0x7f)
            quoted += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            quoted += c;
    }
    return quoted + '"';
}

std::string toml_text(const Vec3& vector)
{
    return fmt::format("[{}, {}, {}]", toml_text(vector.x()), toml_text(vector.y()), toml_text(vector.z()));
}

std::string toml_text(const scene::NumberOrName& value)
{
    return value.name.empty() ? toml_text(value.number) : toml_text(value.name);
}

std::string toml_text(const std::vector<std::string>& list)
{
    std::string text;
    for (const std::string& element : list) text += (text.empty() ? "" : ", ") + toml_text(element);
    return "[" + text + "]";
}

std::string toml_text(const std::vector<scene::Waypoint>& table)
{
    std::string text;
    for (const scene::Waypoint& at : table)
        text += fmt::format("{}[{}, {}, {}, {}]", text.empty() ? "" : ", ", toml_text(at.time), toml_text(at.shift.x()),
            toml_text(at.shift.y()), toml_text(at.shift.z()));
    return "[" + text + "]";
}

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

} // namespace

std::string resolved_scene(const scene::Scene& scene)
{
    std::string text;
    for_each_own_key(scene,
        [&](std::string_view name, const auto& field, std::string_view unit) { write_key(text, name, field, unit); });
    return text;
}

} // namespace talus
