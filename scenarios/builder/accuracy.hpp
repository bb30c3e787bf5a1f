// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/builder/solver.hpp"

#include <string>

namespace talus
{

struct AccuracyChoice {
    RunSetting setting;
    std::string explanation; ///< one line; empty where the scene asks for no accuracy
};

/// The coarsest of the scene's measured settings that has the accuracy which it asks for; where it asks for none, the
/// usual setting. What the scene sets itself stands.
/// @throws SceneError where `accuracy` is no percentage, or smaller than what was measured
AccuracyChoice choose_accuracy(const scene::Scene& scene);

} // namespace talus
