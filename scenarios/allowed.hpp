// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// How the tables of a scene describe their keys.
///
/// `describe(self, key)` calls key(name, field, Allowed, unit, meaning) for each key in order; it serves a const and a
/// mutable self. A field is a bool, std::int64_t, double, std::string, Vec3, NumberOrName, SwitchOrName, a list of
/// strings, another table with a describe of its own, or a std::vector of such tables.
namespace talus::scene
{

/// What a value may be. Numbers lie in [min, max], where `open` leaves min itself out, and are finite unless
/// `infinite`; a string is one of `names` unless that is empty. A key may belong to some kinds of its table only: those
/// that have one of the names in `of` as the value of the table's deciding key.
struct Allowed {
    double min = -infinity;
    double max = infinity;
    bool open = false;
    bool infinite = false;
    std::vector<std::string_view> names = {};
    bool required = false;
    bool decides = false;
    std::vector<std::string_view> of = {};

    /// Whether a table has the key when its deciding key has this value.
    bool belongs_to(std::string_view kind) const { return of.empty() || std::ranges::find(of, kind) != of.end(); }
};

inline Allowed any()
{
    return {};
}
inline Allowed above(double min)
{
    return {.min = min, .open = true};
}
inline Allowed at_least(double min)
{
    return {.min = min};
}
inline Allowed between(double min, double max)
{
    return {.min = min, .max = max};
}
inline Allowed one_of(std::vector<std::string_view> names)
{
    return {.names = std::move(names)};
}
inline Allowed or_infinite(Allowed allowed)
{
    allowed.infinite = true;
    return allowed;
}
inline Allowed required(Allowed allowed)
{
    allowed.required = true;
    return allowed;
}
inline Allowed deciding(Allowed allowed)
{
    allowed.decides = true;
    return allowed;
}
inline Allowed only_for(std::vector<std::string_view> kinds, Allowed allowed)
{
    allowed.of = std::move(kinds);
    return allowed;
}

/// A number, or one of the names that its key allows ("auto", "standard"). The name is empty where a number was given.
struct NumberOrName {
    double number = 0.0;
    std::string name;
};

/// true, false, or one of the names that its key allows. The name is empty where true or false was given.
struct SwitchOrName {
    bool on = false;
    std::string name;
};

} // namespace talus::scene
