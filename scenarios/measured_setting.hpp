// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/allowed.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace talus::scene
{

/// A setting as the studies found it (tests/studies/README.md tells what each error is).
struct MeasuredSetting {
    std::string stabilisation;
    double step_factor = 1.0;
    std::int64_t min_sweeps = 0;
    double tolerance = 0.0;
    double error = 0.0;
    std::string worst;
    double cost = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("stabilisation", self.stabilisation, required(one_of({"matched", "projected"})), "", "");
        key("step_factor", self.step_factor, required(above(0.0)), "", "on the usual time step");
        key("min_sweeps", self.min_sweeps, required(at_least(0)), "", "0: the usual number");
        key("tolerance", self.tolerance, required(above(0.0)), "", "");
        key("error", self.error, required(above(0.0)), "", "the worst over the studies");
        key("worst", self.worst, required(any()), "", "which error that is, and in which study");
        key("cost", self.cost, required(above(0.0)), "",
            "CPU time by that of the usual setting with matched, geometric mean over the studies");
    }
};

/// Settings that accuracy chooses from, from the cheapest to the dearest with each stabilisation.
struct MeasuredSettings {
    std::vector<MeasuredSetting> setting;

    static void describe(auto& self, auto&& key) { key("setting", self.setting, required(any()), "", ""); }
};

} // namespace talus::scene
