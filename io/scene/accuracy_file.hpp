// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/measured_setting.hpp"

#include <filesystem>
#include <vector>

namespace talus
{

/// Reads the settings that accuracy chooses from, which tests/studies/accuracy.py writes.
/// @throws InputError with file, line and column
std::vector<scene::MeasuredSetting> read_measured_settings(const std::filesystem::path& path);

} // namespace talus
