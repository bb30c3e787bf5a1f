// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/key_table.hpp"

#include "io/text/field_kind.hpp"
#include "io/text/input_error.hpp"
#include "io/text/sentence.hpp"
#include "io/text/toml_text.hpp"
#include "io/text/toml_value.hpp"
#include "scenarios/scene.hpp"

#include <fmt/format.h>

#include <vector>

namespace talus
{

namespace
{

/// A key as its line shows it.
struct KeyLine {
    std::string name, value, meaning;
};

/// A table with its lines; those within it come after it.
struct Section {
    std::string path; ///< "fill.region"; empty for the scene itself
    std::vector<KeyLine> keys;
};

std::string names_of(const std::vector<std::string_view>& names)
{
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string default_of(const scene::Allowed& allowed, const auto& field)
{
    if (allowed.required) return "required";
    const std::string text = toml_text(field);
    return text == "\"\"" || text == "[]" ? "may be left out" : fmt::format("default {}", text);
}

/// "a number above 0 [s]; default 1.0; with shape disk".
std::string describe_value(
    std::string_view decider, const scene::Allowed& allowed, const std::string& expected, const std::string& fallback)
{
    std::string text = fmt::format("{}; {}", expected, fallback);
    if (!allowed.of.empty()) text += fmt::format("; with {} {}", decider, names_of(allowed.of));
    return text;
}

/// Collects the sections of a scene, in the order of its tables.
class Sections
{
public:
    template <Table Described> void add(const std::string& path, const Described& defaults)
    {
        const std::size_t here = list_.size();
        list_.push_back({path, {}});
        const std::string_view decider = decision_of(defaults).key;
        Described::describe(defaults, [&](std::string_view name, const auto& field, const scene::Allowed& allowed,
                                          std::string_view unit, std::string_view meaning) {
            const auto [expected, fallback] = value_of({name, allowed, unit}, path, field);
            list_[here].keys.push_back(
                {std::string(name), describe_value(decider, allowed, expected, fallback), std::string(meaning)});
        });
    }

    const std::vector<Section>& list() const { return list_; }

private:
    std::vector<Section> list_;

    /// What is allowed, and what is taken where nothing is given.
    using Value = std::pair<std::string, std::string>;

    Value value_of(const Key& key, const std::string&, const auto& field)
    {
        return {expected_value(key, field), default_of(key.allowed, field)};
    }

    template <Table Described> Value value_of(const Key& key, const std::string& path, const Described& field)
    {
        add(inner(path, key.name), field);
        return {"a table", key.allowed.required ? "required" : "may be left out"};
    }

    template <Table Described> Value value_of(const Key& key, const std::string& path, const std::vector<Described>&)
    {
        add(inner(path, key.name), Described());
        return {"a list of tables", key.allowed.required ? "required" : "may be left out"};
    }

    static std::string inner(const std::string& path, std::string_view name)
    {
        return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
    }
};

std::string text_of(const Section& section)
{
    std::string text = fmt::format("{}\n", section.path.empty() ? "a scene" : section.path);
    for (const KeyLine& key : section.keys) {
        text += fmt::format("  {:<22} {}\n", key.name, key.value);
        if (!key.meaning.empty()) text += fmt::format("  {:<22} {}\n", "", key.meaning);
    }
    return text;
}

} // namespace

std::string key_table(const std::string& table)
{
    Sections sections;
    sections.add("", scene::Scene());
    std::string text;
    std::vector<std::string_view> tables;
    for (const Section& section : sections.list()) {
        const bool inside = section.path == table || section.path.starts_with(table + ".");
        if (table.empty() || inside) text += fmt::format("{}{}", text.empty() ? "" : "\n", text_of(section));
        if (!section.path.empty() && section.path.find('.') == std::string::npos) tables.push_back(section.path);
    }
    if (text.empty())
        throw InputError(fmt::format("a scene has no table '{}'{}; its tables are {}", table,
            did_you_mean(table, tables), enumerate_names(tables, "and")));
    return text;
}

} // namespace talus
