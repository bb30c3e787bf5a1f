// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

/// What a study of a scene runs: the keys of a study file, described as those of a scene are (scene.hpp).
namespace talus::scene
{

/// A key of the scene, and what it is to be one after the other.
struct VariedTable {
    std::string key;
    std::vector<std::string> values;

    static void describe(auto& self, auto&& key)
    {
        key("key", self.key, required(any()), "", "of the scene, as for --set: \"solver.tolerance\"");
        key("values", self.values, required(any()), "",
            "one after the other, as for --set; \"x0.5\" is half of what the scene has, for the time step");
    }
};

struct Study {
    NumberOrName start = {0.0, "auto"};
    NumberOrName end = {0.0, "auto"};
    double settle = 0.2;
    std::int64_t seeds = 1;
    double longest = 1800.0;
    std::vector<std::string> set;
    std::vector<std::string> cross = {"solver.stabilisation"};
    std::vector<std::string> reference = {"solver.stabilisation=matched", "solver.tolerance=reference",
        "solver.min_sweeps=10", "solver.max_sweeps=2000", "time.step=x0.375"};
    std::vector<VariedTable> vary = {
        {"solver.stabilisation", {"matched", "projected"}},
        {"time.step", {"x0.5", "x2", "x4"}},
        {"solver.min_sweeps", {"1", "4", "10"}},
        {"solver.tolerance", {"draft", "fine"}},
        {"solver.relaxation", {"1", "1.5"}},
        {"solver.pressure_scaling", {"true", "false"}},
    };

    static void describe(auto& self, auto&& key)
    {
        key("start", self.start, Allowed{.min = 0.0, .names = {"auto"}}, "s",
            "all settings go on from the state that the scene has then; auto: when its first sensor begins to look, "
            "else half of its duration");
        key("end", self.end, Allowed{.min = 0.0, .open = true, .names = {"auto"}}, "s",
            "of what is measured; auto: the scene's duration");
        key("settle", self.settle, at_least(0.0), "s",
            "after the start, before anything is measured: a setting with stiffer contacts first pushes out what "
            "overlap "
            "the state has, a softer one sinks in");
        key("seeds", self.seeds, between(1, 1000), "", "of the scene, each with a state of its own to start from");
        key("longest", self.longest, above(0.0), "s", "CPU time after which one setting is given up");
        key("set", self.set, any(), "", "changes of the scene for all settings, as for --set: a smaller bed, say");
        key("cross", self.cross, any(), "",
            "keys of which every value is tried with every value of the others, which are varied one at a time; "
            "\"all\": a grid");
        key("reference", self.reference, any(), "", "the settings that errors are measured against, as for --set");
        key("vary", self.vary, any(), "", "");
    }
};

} // namespace talus::scene
