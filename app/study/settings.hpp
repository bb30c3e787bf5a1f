// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/study.hpp"

#include <string>
#include <vector>

namespace talus
{

/// One way to run a scene.
struct Setting {
    std::string name;                   ///< "projected, tolerance=fine"
    std::vector<std::string> overrides; ///< as for --set
};

inline constexpr const char* reference_name = "reference";
inline constexpr const char* default_name = "default";

/// Every setting that a study tries: first the one that errors are measured against, then the scene's own; then each
/// value of each key, one at a time, with every combination of the values of the crossed keys.
/// @param time_step of the scene's own setting [s], for values that are times it
std::vector<Setting> settings_of(const scene::Study& study, double time_step);

} // namespace talus
