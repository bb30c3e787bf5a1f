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

const scene::MeasuredSetting& cheapest_within(double error, const scene::Scene& scene)
{
    const char* law = stabilisation_of(scene.solver) == Stabilisation::matched ? "matched" : "projected";
    double least = infinity;
    for (const scene::MeasuredSetting& measured : scene.measured) {
        if (measured.stabilisation != law) continue;
        if (measured.error <= error) return measured;
        least = std::min(least, measured.error);
    }
    throw SceneError(
        accuracy_key, "'" + percent(error) + "' is finer than what was measured: " + percent(least) +
                          " is the least with this stabilisation; 'talus study' finds settings for a scene");
}

std::string described(const RunSetting& setting)
{
    char step[40], tolerance[40];
    std::snprintf(step, sizeof step, "time step x %g", setting.step_factor);
    std::snprintf(tolerance, sizeof tolerance, "tolerance %g", setting.tolerance);
    const std::string sweeps =
        setting.min_sweeps > 0 ? "at least " + std::to_string(setting.min_sweeps) + " sweeps, " : "";
    return std::string(step) + ", " + sweeps + tolerance;
}

/// What the scene sets itself is not touched.
std::string left_as_it_is(const scene::Scene& scene)
{
    std::string keys;
    const auto add = [&](bool given, const char* name) {
        if (given) keys += (keys.empty() ? "" : ", ") + std::string(name);
    };
    add(scene.time.step.name != "auto", "time.step");
    add(scene.solver.min_sweeps > 0, "solver.min_sweeps");
    add(scene.solver.tolerance.name != "auto", "solver.tolerance");
    return keys.empty() ? "" : "; what the scene sets itself stands: " + keys;
}

} // namespace

AccuracyChoice choose_accuracy(const scene::Scene& scene)
{
    if (scene.accuracy.empty()) return {};
    const double asked = share_of(scene.accuracy);
    const scene::MeasuredSetting& measured = cheapest_within(asked, scene);
    const RunSetting setting = {measured.step_factor, static_cast<int>(measured.min_sweeps), measured.tolerance};
    char cost[80];
    std::snprintf(cost, sizeof cost, "; %.2g times the usual cost", measured.cost);
    return {setting, "accuracy " + percent(asked) + ": " + described(setting) + ", at worst " +
                         percent(measured.error) + " wrong where it was studied (" + measured.worst + ")" + cost +
                         left_as_it_is(scene)};
}

} // namespace talus
