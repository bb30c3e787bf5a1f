// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/study.hpp"

#include <filesystem>
#include <string>

namespace talus
{

/// Reads a study file as strictly as a scene file.
/// @throws InputError with file, line and column
scene::Study read_study(const std::filesystem::path& path);

/// The whole study as TOML, with every key; reading it again gives the same study.
std::string resolved_study(const scene::Study& study);

} // namespace talus
