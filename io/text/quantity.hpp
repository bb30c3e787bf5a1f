// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace talus
{

/// A number with a unit, "5 mm", "60 rpm" or "2.5 g/cm3", in another unit.
/// @param text lengths, masses, times, angles, forces and frequencies, with powers and quotients of them
/// @param unit in which it is wanted: "kg/m3"
/// Returns nothing where either is no such thing, or they measure different things.
std::optional<double> quantity_in(std::string_view text, std::string_view unit);

/// Whether a text is a number with a unit.
bool is_quantity(std::string_view text);

/// The units that a text may name, for people: "m, km, …, and their products and powers".
std::string known_units();

} // namespace talus
