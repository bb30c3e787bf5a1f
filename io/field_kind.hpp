// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <string_view>
#include <vector>

/// The kinds of fields that a scene's `describe` hands out, and the names of their keys.
namespace talus
{

struct IgnoreKey {
    void operator()(auto&&...) const {}
};

/// A table with a `describe` of its own.
template <typename Field>
concept Table = requires(Field& field)
{
    Field::describe(field, IgnoreKey{});
};

template <typename Field> struct ElementOf {
    using type = void;
};
template <typename Element> struct ElementOf<std::vector<Element>> {
    using type = Element;
};

/// A list of tables: [[wall]], or the named tables [materials.NAME].
template <typename Field>
concept TableList = Table<typename ElementOf<Field>::type>;

/// The keys of a table, in the order of its `describe`.
template <Table Described> std::vector<std::string_view> key_names()
{
    std::vector<std::string_view> names;
    Described table;
    Described::describe(table, [&](std::string_view name, auto&&...) { names.push_back(name); });
    return names;
}

} // namespace talus
