// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <string>

namespace talus
{

/// Applies one "--set key=value" to the tables of a scene file, before they are read and checked.
///
/// The value is TOML, or a bare word that stands for a string. A list of tables is entered by the name of an element
/// ("wall.gate.remove_at"), by its pair of materials ("contact.glass-steel.friction", in either order), or by its index
/// from 0 ("fill.0.count"); plain tables that the file leaves out are made. What it puts in has "--set key=value" as
/// the path of its source.
/// @throws InputError where it is not "key=value", the value is not TOML, or no such element is in the scene
void apply_override(toml::table& root, const std::string& key_and_value);

} // namespace talus
