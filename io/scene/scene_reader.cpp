// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_reader.hpp"

#include "io/text/field_kind.hpp"
#include "io/text/input_error.hpp"
#include "io/text/quantity.hpp"
#include "io/text/sentence.hpp"
#include "io/text/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus
{

namespace
{

/// Where a table stands, and how a sentence calls it.
struct Location {
    std::string path;  ///< of keys: "wall[2]"; empty for the scene itself
    std::string title; ///< "[[wall]]"

    std::string key(std::string_view name) const
    {
        return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
    }
};

/// The path of a list without the indices in it: "fill.species" for "fill[0].species".
std::string without_indices(const std::string& path)
{
    std::string text;
    bool inside = false;
    for (const char c : path) {
        inside = inside || c == '[';
        if (!inside) text += c;
        inside = inside && c != ']';
    }
    return text;
}

/// Walks the tables of a scene file along the `describe` functions of the scene's.
class SceneReader
{
public:
    explicit SceneReader(Places& places) : places_(places) {}

    template <Table Described> void read_table(const toml::table& table, const Location& at, Described& described)
    {
        refuse_unknown_keys(table, at, key_names<Described>());
        read_keys(table, at, described, [](const scene::Allowed& key) { return key.decides; });
        const Decision decision = decision_of(described);
        refuse_keys_of_other_kinds(table, at, described, decision);
        read_keys(table, at, described,
            [&](const scene::Allowed& key) { return !key.decides && key.belongs_to(decision.value); });
    }

private:
    Places& places_;

    template <Table Described>
    void read_keys(const toml::table& table, const Location& at, Described& described, auto&& wanted)
    {
        Described::describe(described, [&](std::string_view name, auto& field, const scene::Allowed& allowed,
                                           std::string_view unit, std::string_view meaning) {
            if (!wanted(allowed)) return;
            const toml::node* node = table.get(name);
            if (!node && allowed.required) refuse_missing_key(table, at, name, meaning);
            if (!node) return;
            places_[at.key(name)] = place_in(node->source());
            read_field(*node, at.key(name), Key{name, allowed, unit}, field);
        });
    }

    void read_field(const toml::node& node, const std::string&, const Key& key, auto& field)
    {
        read_value(node, key, field);
    }

    template <Table Described>
    void read_field(const toml::node& node, const std::string& path, const Key& key, Described& field)
    {
        if (!node.is_table()) refuse_value(node, key.name, "a table");
        read_table(*node.as_table(), {path, fmt::format("[{}]", key.name)}, field);
    }

    /// A number alone is short for a constant diameter.
    void read_field(const toml::node& node, const std::string& path, const Key& key, scene::DiameterTable& field)
    {
        if (node.is_table()) return read_field<scene::DiameterTable>(node, path, key, field);
        const auto* text = node.as_string();
        if (!node.is_number() && !(text && is_quantity(text->get())))
            refuse_value(node, key.name, "a number [m] or a table with a distribution");
        const scene::Allowed positive = scene::above(0.0);
        field.distribution = "constant";
        read_value(node, Key{key.name, positive, key.unit}, field.value);
    }

    template <Table Described>
    void read_field(const toml::node& node, const std::string& path, const Key& key, std::vector<Described>& field)
    {
        const toml::array* elements = node.as_array();
        const std::string title = fmt::format("[[{}]]", without_indices(path));
        if (!elements) refuse_value(node, key.name, fmt::format("a list of tables {}", title));
        for (std::size_t i = 0; i < elements->size(); ++i) {
            const toml::node& element = (*elements)[i];
            if (!element.is_table()) refuse_value(element, key.name, fmt::format("a list of tables {}", title));
            const Location at{fmt::format("{}[{}]", path, i), title};
            places_[at.path] = place_in(element.source());
            read_table(*element.as_table(), at, field.emplace_back());
        }
    }

    /// Materials are the tables [materials.NAME], in alphabetical order.
    void read_field(
        const toml::node& node, const std::string& path, const Key& key, std::vector<scene::MaterialTable>& field)
    {
        if (!node.is_table()) refuse_value(node, key.name, "a table of tables [materials.NAME]");
        for (const auto& [name, material] : *node.as_table()) {
            if (!material.is_table()) refuse_value(material, name.str(), "a table [materials.NAME]");
            if (!is_printable(name.str()))
                throw InputError(
                    fmt::format("{}: the name of a material must be {}", place_in(name.source()), printable_text));
            const Location at{fmt::format("{}.{}", path, name.str()), fmt::format("[materials.{}]", name.str())};
            places_[at.path] = place_in(material.source());
            field.emplace_back().name = name.str();
            read_table(*material.as_table(), at, field.back());
        }
    }

    static void refuse_unknown_keys(
        const toml::table& table, const Location& at, const std::vector<std::string_view>& known)
    {
        for (const auto& [name, node] : table) {
            if (std::ranges::find(known, name.str()) != known.end()) continue;
            const std::string nearest = did_you_mean(name.str(), known);
            throw InputError(fmt::format("{}: unknown key '{}' in {}{}", place_in(name.source()), one_line(name.str()),
                at.title, nearest.empty() ? fmt::format("; its keys are {}", enumerate_names(known, "and")) : nearest));
        }
    }

    /// Refuses the `hole_radius` of a plane: a key that would have no effect.
    template <Table Described>
    static void refuse_keys_of_other_kinds(
        const toml::table& table, const Location& at, const Described& described, const Decision& decision)
    {
        std::vector<std::string_view> own;
        for_each_own_key(described, [&](std::string_view name, auto&&...) { own.push_back(name); });
        Described::describe(described, [&](std::string_view name, auto&, const scene::Allowed& allowed, auto&&...) {
            const auto found = table.find(name);
            if (found == table.end() || allowed.belongs_to(decision.value)) return;
            throw InputError(fmt::format("{}: key '{}' in {} goes with {} {}, not '{}', whose keys are {}",
                place_in(found->first.source()), name, at.title, decision.key, enumerate_names(allowed.of, "or"),
                decision.value, enumerate_names(own, "and")));
        });
    }

    [[noreturn]] static void refuse_missing_key(
        const toml::table& table, const Location& at, std::string_view name, std::string_view meaning)
    {
        throw InputError(fmt::format("{}: {} needs the key '{}'{}", place_in(table.source()), at.title, name,
            meaning.empty() ? "" : fmt::format(" ({})", meaning)));
    }
};

} // namespace

scene::Scene read_tables(const toml::table& root, Places& places)
{
    scene::Scene scene;
    SceneReader(places).read_table(root, {"", "the scene"}, scene);
    return scene;
}

scene::MeasuredSettings read_measured_tables(const toml::table& root, Places& places)
{
    scene::MeasuredSettings measured;
    SceneReader(places).read_table(root, {"", "the file"}, measured);
    return measured;
}

} // namespace talus
