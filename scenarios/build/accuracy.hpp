// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/build/solver.hpp"

#include <string>
#include <vector>

namespace talus
{

/// A setting as the studies found it (tests/studies/README.md tells what each error is).
struct MeasuredSetting {
    Stabilisation stabilisation = Stabilisation::matched;
    RunSetting setting;
    double error = 0.0;     ///< the worst over the studies
    const char* worst = ""; ///< which error that is, and in which study
    double cost = 1.0;      ///< CPU time by that of the usual setting with `matched`, geometric mean over the studies
};

/// The settings for which no cheaper one of the same stabilisation is as accurate, from the cheapest to the dearest.
const std::vector<MeasuredSetting>& measured_settings();

struct AccuracyChoice {
    RunSetting setting;
    std::string explanation; ///< one line; empty where the scene asks for no accuracy
};

/// The cheapest measured setting that has the accuracy which the scene asks for, with the scene's stabilisation. Where
/// it asks for none, the usual setting.
/// @throws SceneError where `accuracy` is no percentage, or smaller than what was measured
AccuracyChoice choose_accuracy(const scene::Scene& scene);

} // namespace talus
