// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/toml_value.hpp"

#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/quantity.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace talus
{

namespace
{

std::string expected_numbers(std::string_view noun, const Key& key)
{
    const auto& allowed = key.allowed;
    std::string text(noun);
    if (allowed.min > -infinity) text += fmt::format(" {} {}", allowed.open ? "above" : "of at least", allowed.min);
    if (allowed.max < infinity) text += fmt::format(" and at most {}", allowed.max);
    if (!key.unit.empty()) text += fmt::format(" [{}]", key.unit);
    if (allowed.infinite) text += " or inf";
    return text;
}

bool is_allowed(double number, const scene::Allowed& allowed)
{
    if (std::isnan(number) || (std::isinf(number) && !allowed.infinite)) return false;
    return (allowed.open ? number > allowed.min : number >= allowed.min) && number <= allowed.max;
}

/// Refuses numbers whose products with others of a scene would be none.
void require_sensible(double number, const toml::node& node, const Key& key)
{
    constexpr double largest = 1e30, smallest = 1e-30;
    const double size = std::abs(number);
    if (std::isfinite(number) && size > largest)
        throw InputError(fmt::format("{}: '{}' is {:.3g}, and numbers of a scene are at most 1e30 in size",
            place_in(node.source()), key.name, number));
    if (key.allowed.open && key.allowed.min == 0.0 && size > 0.0 && size < smallest)
        throw InputError(fmt::format("{}: '{}' is {:.3g}, and what must be above 0 is at least 1e-30",
            place_in(node.source()), key.name, number));
}

/// The number that a node is, whole or not, or as text with a unit, if it is allowed.
/// @param unit that of the key, or of the one number of several
std::optional<double> allowed_number(const toml::node& node, const Key& key, std::string_view unit)
{
    const auto* text = node.as_string();
    const auto number = node.is_number() ? node.value<double>() : text ? quantity_in(text->get(), unit) : std::nullopt;
    if (!number) return std::nullopt;
    require_sensible(*number, node, key);
    return is_allowed(*number, key.allowed) ? number : std::nullopt;
}

std::optional<double> allowed_number(const toml::node& node, const Key& key)
{
    return allowed_number(node, key, key.unit);
}

bool is_allowed(const std::string& text, const scene::Allowed& allowed)
{
    return allowed.names.empty() || std::ranges::find(allowed.names, text) != allowed.names.end();
}

/// The string itself, unless that is long or no text to print.
std::string describe_string(const std::string& text)
{
    constexpr std::size_t longest_shown = 60;
    const bool fits = text.size() <= longest_shown && is_printable(text);
    return fits ? fmt::format("the string '{}'", text) : fmt::format("a string of {} bytes", text.size());
}

/// Refuses a value where a choice of names was wanted, with the nearest of them.
[[noreturn]] void refuse_name(const toml::node& node, const Key& key, const std::string& expected)
{
    const std::string given = node.value<std::string>().value_or("");
    throw InputError(fmt::format("{}: '{}' must be {}, not {}{}", place_in(node.source()), key.name, expected,
        describe_value(node), did_you_mean(given, key.allowed.names)));
}

} // namespace

std::string place_in(const toml::source_region& source)
{
    const std::string path = source.path ? *source.path : std::string();
    if (path.starts_with(override_prefix)) return path;
    return fmt::format("{}:{}:{}", path, source.begin.line, source.begin.column);
}

std::string describe_error(const toml::parse_error& error)
{
    return fmt::format("not TOML: {}", one_line(error.description()));
}

toml::table parse_toml(std::string_view text, const std::string& source)
{
    try {
        return toml::parse(text, source);
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}: {}", place_in(error.source()), describe_error(error)));
    }
}

toml::table parse_toml_file(const std::filesystem::path& path, const std::string& kind)
{
    // Far above any scene or study, which holds numbers and names; geometry lies in files of its own.
    constexpr std::uintmax_t largest = 1 << 20;
    return parse_toml(read_bytes(path, kind, largest), path.string());
}

std::string describe_value(const toml::node& node)
{
    if (const auto* text = node.as_string()) return describe_string(text->get());
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
    if (const auto* array = node.as_array()) return fmt::format("an array of {}", array->size());
    return node.is_table() ? "a table" : "a date or time";
}

void refuse_value(const toml::node& node, std::string_view key, std::string_view expected)
{
    throw InputError(
        fmt::format("{}: '{}' must be {}, not {}", place_in(node.source()), key, expected, describe_value(node)));
}

std::string expected_value(const Key&, const bool&)
{
    return "true or false";
}

std::string expected_value(const Key& key, const std::int64_t&)
{
    return expected_numbers("a whole number", key);
}

std::string expected_value(const Key& key, const double&)
{
    return expected_numbers("a number", key);
}

std::string expected_value(const Key& key, const std::string&)
{
    return key.allowed.names.empty() ? "a string" : enumerate_names(key.allowed.names, "or");
}

std::string expected_value(const Key& key, const Vec3&)
{
    return expected_numbers("three numbers", key);
}

std::string expected_value(const Key& key, const scene::NumberOrName&)
{
    return fmt::format("{}, or {}", expected_numbers("a number", key), enumerate_names(key.allowed.names, "or"));
}

std::string expected_value(const Key& key, const scene::SwitchOrName&)
{
    return fmt::format("true, false or {}", enumerate_names(key.allowed.names, "or"));
}

std::string expected_value(const Key&, const std::vector<scene::Waypoint>&)
{
    return "rows of four numbers [time, x, y, z]";
}

std::string expected_value(const Key&, const std::vector<scene::LoadRow>&)
{
    return "a number [N] or rows of two numbers [time, force]";
}

std::string expected_value(const Key& key, const std::vector<std::string>&)
{
    if (key.allowed.names.empty()) return "an array of strings";
    return fmt::format("an array of {}", enumerate_names(key.allowed.names, "and"));
}

void read_value(const toml::node& node, const Key& key, bool& field)
{
    const auto* truth = node.as_boolean();
    if (!truth) refuse_value(node, key.name, expected_value(key, field));
    field = truth->get();
}

void read_value(const toml::node& node, const Key& key, std::int64_t& field)
{
    const auto* number = node.as_integer();
    if (!number || !is_allowed(static_cast<double>(number->get()), key.allowed))
        refuse_value(node, key.name, expected_value(key, field));
    field = number->get();
}

void read_value(const toml::node& node, const Key& key, double& field)
{
    const auto number = allowed_number(node, key);
    if (!number) refuse_value(node, key.name, expected_value(key, field));
    field = *number;
}

void read_value(const toml::node& node, const Key& key, std::string& field)
{
    const auto* text = node.as_string();
    if (!text || !is_allowed(text->get(), key.allowed)) refuse_name(node, key, expected_value(key, field));
    if (!is_printable(text->get())) refuse_value(node, key.name, printable_text);
    field = text->get();
}

void read_value(const toml::node& node, const Key& key, Vec3& field)
{
    const auto* array = node.as_array();
    const std::string expected = expected_value(key, field);
    if (!array || array->size() != 3) refuse_value(node, key.name, expected);
    for (int i = 0; i < 3; ++i) {
        const toml::node& component = (*array)[static_cast<std::size_t>(i)];
        const auto number = allowed_number(component, key);
        if (!number) refuse_value(component, key.name, expected);
        field[i] = *number;
    }
}

void read_value(const toml::node& node, const Key& key, scene::NumberOrName& field)
{
    const std::string expected = expected_value(key, field);
    const auto* text = node.as_string();
    if (text && is_allowed(text->get(), key.allowed)) {
        field = {0.0, text->get()};
    } else if (const auto number = allowed_number(node, key)) {
        field = {*number, ""};
    } else if (text) {
        refuse_name(node, key, expected);
    } else {
        refuse_value(node, key.name, expected);
    }
}

void read_value(const toml::node& node, const Key& key, scene::SwitchOrName& field)
{
    if (const auto* truth = node.as_boolean()) {
        field = {truth->get(), ""};
    } else {
        const auto* text = node.as_string();
        if (!text || !is_allowed(text->get(), key.allowed)) refuse_name(node, key, expected_value(key, field));
        field = {false, text->get()};
    }
}

void read_value(const toml::node& node, const Key& key, std::vector<std::string>& field)
{
    const std::string expected = expected_value(key, field);
    const auto* array = node.as_array();
    if (!array) refuse_value(node, key.name, expected);
    field.clear();
    for (const toml::node& element : *array) {
        const auto* text = element.as_string();
        if (!text || !is_allowed(text->get(), key.allowed)) refuse_name(element, key, expected);
        field.push_back(text->get());
    }
}

/// Reads rows of so many numbers each, in these units, and hands each row to `add`.
template <std::size_t columns>
void read_rows(const toml::node& node, const Key& key, const std::array<std::string_view, columns>& units,
    const std::string& expected, auto&& add)
{
    const auto* array = node.as_array();
    if (!array) refuse_value(node, key.name, expected);
    for (const toml::node& element : *array) {
        const auto* row = element.as_array();
        if (!row || row->size() != columns) refuse_value(element, key.name, expected);
        std::array<double, columns> numbers;
        for (std::size_t k = 0; k < columns; ++k) {
            const auto number = allowed_number((*row)[k], key, units[k]);
            if (!number) refuse_value((*row)[k], key.name, expected);
            numbers[k] = *number;
        }
        add(numbers);
    }
}

void read_value(const toml::node& node, const Key& key, std::vector<scene::Waypoint>& field)
{
    field.clear();
    read_rows<4>(node, key, {"s", "m", "m", "m"}, expected_value(key, field), [&](const std::array<double, 4>& row) {
        field.push_back({row[0], Vec3(row[1], row[2], row[3])});
    });
}

/// A number alone is short for a load that never changes.
void read_value(const toml::node& node, const Key& key, std::vector<scene::LoadRow>& field)
{
    if (const auto force = allowed_number(node, key)) {
        field = {{0.0, *force}};
        return;
    }
    field.clear();
    read_rows<2>(node, key, {"s", "N"}, expected_value(key, field), [&](const std::array<double, 2>& row) {
        field.push_back({row[0], row[1]});
    });
}

} // namespace talus
