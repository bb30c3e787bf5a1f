// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/settings.hpp"

#include "app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace talus
{
namespace
{

const std::string step_key = "time.step";

/// "x0.5" of a time step is a number of seconds.
std::string in_seconds(const std::string& value, double time_step)
{
    double factor = 0.0;
    const char* end = value.data() + value.size();
    const auto [parsed_to, error] = std::from_chars(value.data() + 1, end, factor);
    if (error != std::errc{} || parsed_to != end || !(factor > 0.0))
        throw UsageError(fmt::format("'{}' is not x and a number above 0, as in x0.5", value));
    return fmt::format("{}", factor * time_step);
}

std::string override_text(const std::string& key, const std::string& value, double time_step)
{
    const bool multiple = key == step_key && value.starts_with("x");
    return fmt::format("{}={}", key, multiple ? in_seconds(value, time_step) : value);
}

/// An override as people write it: of "solver.tolerance=fine" the key's last word; of the stabilisation its value.
std::string short_name(const std::string& key, const std::string& value)
{
    if (key == "solver.stabilisation") return value;
    const std::size_t dot = key.rfind('.');
    return fmt::format("{}={}", dot == std::string::npos ? key : key.substr(dot + 1), value);
}

struct Choice {
    std::string key, value;
};

Setting setting_of(const std::vector<Choice>& choices, double time_step)
{
    Setting setting;
    std::vector<std::string> names;
    for (const auto& [key, value] : choices) {
        names.push_back(short_name(key, value));
        setting.overrides.push_back(override_text(key, value, time_step));
    }
    setting.name = names.empty() ? default_name : fmt::format("{}", fmt::join(names, ", "));
    return setting;
}

/// Each of them with each value of one key more.
std::vector<std::vector<Choice>> crossed_with(
    const std::vector<std::vector<Choice>>& combinations, const scene::VariedTable& varied)
{
    std::vector<std::vector<Choice>> crossed;
    for (const auto& combination : combinations)
        for (const std::string& value : varied.values) {
            crossed.push_back(combination);
            crossed.back().push_back({varied.key, value});
        }
    return crossed;
}

Choice choice_of(const std::string& override_of_reference)
{
    const std::size_t equals = override_of_reference.find('=');
    if (equals == std::string::npos)
        throw UsageError(fmt::format("the reference's '{}' is not key=value", override_of_reference));
    return {override_of_reference.substr(0, equals), override_of_reference.substr(equals + 1)};
}

Setting reference_of(const scene::Study& study, double time_step)
{
    std::vector<Choice> choices;
    for (const std::string& text : study.reference) choices.push_back(choice_of(text));
    Setting setting = setting_of(choices, time_step);
    setting.name = reference_name;
    return setting;
}

} // namespace

std::vector<Setting> settings_of(const scene::Study& study, double time_step)
{
    const bool grid = std::ranges::find(study.cross, "all") != study.cross.end();
    const auto is_crossed = [&](const scene::VariedTable& varied) {
        return grid || std::ranges::find(study.cross, varied.key) != study.cross.end();
    };
    std::vector<std::vector<Choice>> combinations = {{}};
    for (const auto& varied : study.vary)
        if (is_crossed(varied)) combinations = crossed_with(combinations, varied);

    std::vector<std::vector<Choice>> all = combinations;
    for (const auto& varied : study.vary)
        if (!is_crossed(varied)) std::ranges::copy(crossed_with(combinations, varied), std::back_inserter(all));

    std::vector<Setting> settings = {reference_of(study, time_step), setting_of({}, time_step)};
    for (const auto& choices : all)
        if (!choices.empty()) settings.push_back(setting_of(choices, time_step));
    return settings;
}

} // namespace talus
