// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/measured_setting.hpp"

#include <vector>

namespace talus::test
{

/// The settings that come with Talus for scenes that ask for an accuracy.
const std::vector<scene::MeasuredSetting>& measured_settings();

} // namespace talus::test
