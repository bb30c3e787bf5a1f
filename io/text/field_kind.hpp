// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The kinds of fields that a scene's `describe` hands out, the names of their keys, and which of them a table has.
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

/// The key of a table that decides which others it has, with its value: shape = "disk". Empty where there is none.
struct Decision {
    std::string_view key;
    std::string value;
};

template <Table Described> Decision decision_of(const Described& table)
{
    Decision decision;
    Described::describe(table,
        [&]<typename Field>(std::string_view name, const Field& field, const scene::Allowed& allowed, auto&&...) {
            if constexpr (std::is_same_v<Field, std::string>)
                if (allowed.decides) decision = {name, field};
        });
    return decision;
}

/// Calls visit(name, field, unit) for the keys that this table has, in order.
template <Table Described> void for_each_own_key(const Described& table, auto&& visit)
{
    const Decision decision = decision_of(table);
    Described::describe(table, [&](std::string_view name, const auto& field, const scene::Allowed& allowed,
                                   std::string_view unit, std::string_view) {
        if (allowed.belongs_to(decision.value)) visit(name, field, unit);
    });
}

} // namespace talus
