// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/run_origin.hpp"

#include "io/scene/scene_file.hpp"
#include "io/text/input_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace talus
{
namespace
{

/// What says how long a run is and what is written of it, but not where the spheres go from one step to the next; and
/// how exactly they go. A name in brackets stands for all keys of its table.
constexpr std::array<std::string_view, 10> changeable = {"title", "time.duration", "time.frame_interval",
    "time.metrics_interval", "[output]", "[checkpoint]", "solver.tolerance", "solver.max_sweeps",
    "solver.on_no_solution", "world.on_escape"};

/// How spheres go on from a state.
constexpr std::array<std::string_view, 7> settings = {
    "[time]", "[solver]", "[targets]", "accuracy", "[contact]", "[sensor]", "world.gravity"};

/// @param key with an index where its table is one of a list: "contact[0].friction"
bool is_among(const auto& names, const std::string& key)
{
    const std::string table = fmt::format("[{}]", key.substr(0, key.find_first_of(".[")));
    return std::ranges::any_of(names, [&](std::string_view one) { return one == key || one == table; });
}

} // namespace

RunOrigin origin_of(const std::string& scene_name, const scene::Scene& scene)
{
    const auto files = named_files(scene);
    RunOrigin origin{scene_name, resolved_scene(with_copies(scene, files)), {}};
    for (const NamedFile& file : files) origin.files.push_back(file.sum);
    return origin;
}

void refuse_other_scene(const SceneFile& file, const RunOrigin& origin)
{
    const auto files = named_files(file.scene);
    for (const std::string& key : changed_keys(parse_scene(origin.scene), with_copies(file.scene, files)))
        if (!is_among(changeable, key))
            throw InputError(fmt::format("{}: '{}' may not change when a run is resumed; what may is {}",
                file.place_of(key), key, fmt::join(changeable, ", ")));
    for (std::size_t k = 0; k < files.size(); ++k)
        if (files[k].sum != origin.files.at(k))
            throw InputError(fmt::format(
                "{}: the file has changed since the run began; it goes on only with the old one", files[k].path));
}

void refuse_other_state(const RunOrigin& own, const RunOrigin& origin)
{
    for (const std::string& key : changed_keys(parse_scene(origin.scene), parse_scene(own.scene)))
        if (!is_among(changeable, key) && !is_among(settings, key))
            throw InputError(fmt::format("the state is of another scene: '{}' differs; what may is {}, {}", key,
                fmt::join(changeable, ", "), fmt::join(settings, ", ")));
    if (own.files != origin.files) throw InputError("the state is of a scene with other contents of its files");
}

} // namespace talus
