// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model.hpp"

#include <string>
#include <vector>

namespace talus
{

/// By which an incident names the wall touched last.
inline std::vector<std::string> wall_names(const Model& model)
{
    std::vector<std::string> names;
    for (const Wall& wall : model.walls) names.push_back(wall.name);
    return names;
}

} // namespace talus
