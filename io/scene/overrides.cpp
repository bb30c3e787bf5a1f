// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/overrides.hpp"

#include "io/text/field_kind.hpp"
#include "io/text/input_error.hpp"
#include "io/text/quantity.hpp"
#include "io/text/sentence.hpp"
#include "io/text/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace talus
{

namespace
{

struct Override {
    std::string place; ///< "--set key=value"
    std::vector<std::string> keys;
    std::string value; ///< as TOML

    [[noreturn]] void refuse(const std::string& sentence) const
    {
        throw InputError(fmt::format("{}: {}", place, sentence));
    }

    /// The keys from `first` on and the value, parsed, so that every node knows that it comes from here.
    toml::table parsed_from(std::size_t first) const
    {
        std::string path;
        for (std::size_t i = first; i < keys.size(); ++i) path += fmt::format("{}'{}'", i > first ? "." : "", keys[i]);
        try {
            return toml::parse(fmt::format("{} = {}", path, value), place);
        } catch (const toml::parse_error& error) {
            refuse(describe_error(error));
        }
    }
};

bool is_toml_value(const std::string& text)
{
    try {
        return toml::parse("value = " + text).size() == 1;
    } catch (const toml::parse_error&) {
        return false;
    }
}

/// A word that may stand for a string without its quotes: letters first, a percentage or a number with a unit, and
/// nothing that TOML would read as structure.
bool is_bare_word(const std::string& text)
{
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (text.empty()) return false;
    return (is_letter(text.front()) || is_quantity(text) || text.front() == '/' || text.front() == '.' ||
               text.back() == '%') &&
           text.find_first_of("'\"=[]{},#\\") == std::string::npos;
}

std::string trimmed(const std::string& text)
{
    const std::size_t begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

std::vector<std::string> split_at_dots(const std::string& path)
{
    std::vector<std::string> keys;
    for (std::size_t from = 0; from <= path.size();) {
        const std::size_t dot = std::min(path.find('.', from), path.size());
        keys.push_back(path.substr(from, dot - from));
        from = dot + 1;
    }
    return keys;
}

Override parse_override(const std::string& text)
{
    Override parsed{one_line(fmt::format("{}{}", override_prefix, text)), {}, {}};
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string path = trimmed(text.substr(0, equals));
    if (one_line(text) != text || equals == text.size() || path.empty()) parsed.refuse("must be key=value on one line");

    parsed.keys = split_at_dots(path);
    for (const std::string& key : parsed.keys)
        if (key.empty() || key.find('\'') != std::string::npos) parsed.refuse("its keys must be names joined by dots");

    parsed.value = trimmed(text.substr(equals + 1));
    if (!is_toml_value(parsed.value)) {
        if (!is_bare_word(parsed.value)) parsed.refuse(fmt::format("'{}' is not a TOML value", parsed.value));
        parsed.value = fmt::format("'{}'", parsed.value);
    }
    return parsed;
}

/// Whether a key of the scene holds a list of tables; materials, which are tables by name, count as one.
bool is_list_of_tables(const std::string& key)
{
    bool found = false;
    scene::Scene scene;
    scene::Scene::describe(scene, [&]<typename Field>(std::string_view name, Field&, auto&&...) {
        if constexpr (TableList<Field>) found = found || name == key;
    });
    return found;
}

/// A table of a list, under a name by which the command line may call it.
struct Element {
    std::string name;
    toml::node* node;
};

/// The name in the table, else its two materials in both orders, else its index.
std::vector<Element> named_elements(toml::node& node, std::size_t index)
{
    const toml::node_view view(node);
    if (const auto name = view["name"].value<std::string>(); name && !name->empty()) return {{*name, &node}};
    const auto first = view["between"][0].value<std::string>();
    const auto second = view["between"][1].value<std::string>();
    if (first && second) return {{*first + "-" + *second, &node}, {*second + "-" + *first, &node}};
    return {{std::to_string(index), &node}};
}

std::vector<Element> elements_of(toml::node* list)
{
    std::vector<Element> elements;
    if (list && list->is_table())
        for (auto&& [key, node] : *list->as_table()) elements.push_back({std::string(key.str()), &node});
    if (list && list->is_array())
        for (std::size_t i = 0; i < list->as_array()->size(); ++i)
            std::ranges::move(named_elements((*list->as_array())[i], i), std::back_inserter(elements));
    return elements;
}

toml::node* element_at_index(toml::node* list, const std::string& key)
{
    toml::array* array = list ? list->as_array() : nullptr;
    for (std::size_t i = 0; array && i < array->size(); ++i)
        if (std::to_string(i) == key) return array->get(i);
    return nullptr;
}

/// The table that the first two keys name: "wall.gate", "materials.glass", "fill.0".
toml::node& find_element(toml::table& root, const Override& set)
{
    toml::node* list = root.get(set.keys[0]);
    const std::vector<Element> elements = elements_of(list);
    const auto found = std::ranges::find(elements, set.keys[1], &Element::name);
    if (found != elements.end()) return *found->node;
    if (toml::node* element = element_at_index(list, set.keys[1])) return *element;

    std::vector<std::string_view> names;
    for (const Element& element : elements)
        if (std::ranges::find(names, element.name) == names.end()) names.push_back(element.name);
    std::string help = did_you_mean(set.keys[1], names);
    if (help.empty() && !names.empty()) help = fmt::format("; there is {}", enumerate_names(names, "and"));
    set.refuse(fmt::format("the scene has no {} '{}'{}", set.keys[0], set.keys[1], help));
}

/// Puts what the override says from `depth` on into a table that has no such key, or has the value to be replaced.
void insert_rest(toml::table& table, const Override& set, std::size_t depth)
{
    toml::table rest = set.parsed_from(depth);
    for (auto&& [key, node] : rest) table.insert_or_assign(key, std::move(node));
}

} // namespace

void apply_override(toml::table& root, const std::string& key_and_value)
{
    const Override set = parse_override(key_and_value);
    toml::node* node = &root;
    std::size_t depth = 0;
    if (set.keys.size() > 1 && is_list_of_tables(set.keys[0])) {
        node = &find_element(root, set);
        depth = 2;
    }
    if (depth == set.keys.size()) set.refuse("it must name one key of that table");
    for (;; ++depth) {
        if (toml::node* element = element_at_index(node, set.keys[depth]); element && depth + 1 < set.keys.size()) {
            node = element;
            ++depth;
        }
        toml::table* table = node->as_table();
        if (!table) set.refuse(fmt::format("'{}' is {} and has no keys", set.keys[depth - 1], describe_value(*node)));
        toml::node* next = table->get(set.keys[depth]);
        if (!next || depth + 1 == set.keys.size()) return insert_rest(*table, set, depth);
        node = next;
    }
}

} // namespace talus
