// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "scenarios/scene.hpp"

#include <string>

namespace talus
{

/// @param key the path of the region, for errors; @throws SceneError where the region is empty
Region build_region(const scene::RegionTable& table, const std::string& key);

} // namespace talus
