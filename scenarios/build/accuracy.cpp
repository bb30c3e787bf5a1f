// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/accuracy.hpp"

#include "scenarios/scene_error.hpp"

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

const MeasuredSetting& cheapest_within(double error, Stabilisation stabilisation)
{
    const MeasuredSetting* best = nullptr;
    for (const MeasuredSetting& measured : measured_settings()) {
        if (measured.stabilisation != stabilisation) continue;
        if (measured.error <= error) return measured;
        best = &measured;
    }
    throw SceneError(
        accuracy_key, "'" + percent(error) + "' is finer than what was measured: " + percent(best->error) +
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

const std::vector<MeasuredSetting>& measured_settings()
{
    using enum Stabilisation;
    static const std::vector<MeasuredSetting> settings = {
        {matched, {4.0, 0, 1e-2}, 0.64, "creep of column_100", 0.32},
        {matched, {2.0, 0, 1e-2}, 0.133, "creep of column_100", 0.51},
        {matched, {1.0, 0, 5e-2}, 0.0182, "overlap_95 of heavy_on_light", 0.90},
        {matched, {1.0, 4, 1e-2}, 0.0096, "overlap_95 of heavy_on_light", 1.22},
        {matched, {1.0, 10, 1e-2}, 0.0053, "overlap_95 of heavy_on_light", 1.87},
        {projected, {4.0, 0, 1e-2}, 0.0742, "overlap_95 of heavy_on_light", 0.48},
        {projected, {2.0, 0, 1e-2}, 0.0223, "creep of column_20", 0.84},
        {projected, {1.0, 0, 1e-2}, 0.0079, "velocity_error of silo_at_rest", 1.72},
        {projected, {0.5, 0, 1e-2}, 0.0048, "velocity_error of silo_at_rest", 3.70},
    };
    return settings;
}

AccuracyChoice choose_accuracy(const scene::Scene& scene)
{
    if (scene.accuracy.empty()) return {};
    const double asked = share_of(scene.accuracy);
    const MeasuredSetting& measured = cheapest_within(asked, stabilisation_of(scene.solver));
    char cost[80];
    std::snprintf(cost, sizeof cost, "; %.2g times the usual cost", measured.cost);
    return {measured.setting, "accuracy " + percent(asked) + ": " + described(measured.setting) + ", at worst " +
                                  percent(measured.error) + " wrong where it was studied (" + measured.worst + ")" +
                                  cost + left_as_it_is(scene)};
}

} // namespace talus
