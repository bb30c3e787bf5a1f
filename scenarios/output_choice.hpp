// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "scenarios/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace talus
{

/// What a scene wants to see in its frames; by default, what a scene gets that asks for nothing. `OutputTable` of
/// scene.hpp lists the arrays.
struct OutputChoice {
    std::vector<std::string> particle_arrays = scene::OutputTable().particle_arrays;
    std::vector<std::string> contact_arrays = scene::OutputTable().contact_arrays;
    double contact_threshold = 0.0; ///< contacts with no more force than this are left out, in mean forces
    std::optional<Region> region;   ///< only what lies in it; nothing: everything
};

} // namespace talus
