// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <toml++/toml.h>

#include <map>
#include <string>

namespace talus
{

/// Key path → place, as in SceneFile::places.
using Places = std::map<std::string, std::string>;

/// Reads every key of the scene from the tables of a file, and notes where each stands.
/// @throws InputError on the first key that is unknown, missing or not allowed
scene::Scene read_tables(const toml::table& root, Places& places);

/// Reads the settings that accuracy chooses from.
/// @throws InputError as above
scene::MeasuredSettings read_measured_tables(const toml::table& root, Places& places);

} // namespace talus
