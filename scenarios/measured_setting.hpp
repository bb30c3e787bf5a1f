// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/allowed.hpp"

#include <string>
#include <vector>

namespace talus::scene
{

/// What a run keeps to, so that its results are no more wrong than this (tests/studies/README.md).
struct MeasuredSetting {
    double bound = 0.0;
    double overlap = 0.0;
    double creep = 0.0;
    double approach = 0.0;
    double tolerance = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("bound", self.bound, required(above(0.0)), "", "on flows, angles, profiles and mean forces, of each");
        key("overlap", self.overlap, required(above(0.0)), "", "targets of the automatic step");
        key("creep", self.creep, required(above(0.0)), "", "");
        key("approach", self.approach, required(above(0.0)), "", "");
        key("tolerance", self.tolerance, required(above(0.0)), "", "");
    }
};

/// Settings that accuracy chooses from, from the coarsest to the finest.
struct MeasuredSettings {
    std::vector<MeasuredSetting> setting;

    static void describe(auto& self, auto&& key) { key("setting", self.setting, required(any()), "", ""); }
};

} // namespace talus::scene
