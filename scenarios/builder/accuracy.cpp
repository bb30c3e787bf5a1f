// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/accuracy.hpp"

#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace talus
{
namespace
{

constexpr const char* accuracy_key = "accuracy";

std::string percent(double share)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
    return text;
}

/// "1%" or "1 %" is 0.01.
double share_of(const std::string& text)
{
    double number = 0.0;
    const char* end = text.data() + text.size();
    auto [at, error] = std::from_chars(text.data(), end, number);
    while (at != end && *at == ' ') ++at;
    if (error != std::errc{} || at == end || std::string(at, end) != "%" || !(number > 0.0 && number <= 100.0))
        throw SceneError(accuracy_key, "'" + text + "' must be a percentage above 0 and up to 100, like \"1%\"");
    return 0.01 * number;
}

/// The coarsest whose bound is no larger.
const scene::MeasuredSetting& coarsest_within(double error, const scene::Scene& scene)
{
    double least = infinity;
    for (const scene::MeasuredSetting& measured : scene.measured) {
        if (measured.bound <= error) return measured;
        least = std::min(least, measured.bound);
    }
    throw SceneError(accuracy_key, std::string("'") + percent(error) + "' is finer than what was measured: " +
                                       percent(least) + " is the least; 'talus study' finds settings for a scene");
}

std::string described(const RunSetting& setting)
{
    const auto& [overlap, creep, approach] = setting.targets;
    char line[160];
    std::snprintf(line, sizeof line, "overlap %g d, approach %g d, creep %g, tolerance %g", overlap, approach, creep,
        setting.tolerance);
    return line;
}

/// With the targets that the scene sets itself.
RunSetting with_own_targets(RunSetting setting, const scene::TargetsTable& own)
{
    const auto take = [](double& target, const scene::NumberOrName& value) {
        if (value.name != "auto") target = value.number;
    };
    take(setting.targets.overlap, own.overlap);
    take(setting.targets.creep, own.creep);
    take(setting.targets.approach, own.approach);
    return setting;
}

std::string left_as_it_is(const scene::Scene& scene)
{
    std::string keys;
    const auto add = [&](bool given, const char* name) {
        if (given) keys += (keys.empty() ? "" : ", ") + std::string(name);
    };
    add(scene.time.step.name != "auto", "time.step");
    add(scene.solver.min_sweeps > 0, "solver.min_sweeps");
    add(scene.targets.overlap.name != "auto", "targets.overlap");
    add(scene.targets.creep.name != "auto", "targets.creep");
    add(scene.targets.approach.name != "auto", "targets.approach");
    add(scene.solver.tolerance.name != "auto", "solver.tolerance");
    return keys.empty() ? "" : "; what the scene sets itself stands: " + keys;
}

} // namespace

AccuracyChoice choose_accuracy(const scene::Scene& scene)
{
    if (scene.accuracy.empty()) return {with_own_targets({}, scene.targets), ""};
    const double asked = share_of(scene.accuracy);
    const scene::MeasuredSetting& measured = coarsest_within(asked, scene);
    const RunSetting setting =
        with_own_targets({{measured.overlap, measured.creep, measured.approach}, measured.tolerance}, scene.targets);
    return {setting, "accuracy " + percent(asked) + ": " + described(setting) + left_as_it_is(scene)};
}

} // namespace talus
