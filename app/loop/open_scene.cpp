// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/open_scene.hpp"

#include "app/system/terminal.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/build/build_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace talus
{

namespace fs = std::filesystem;

fs::path scene_path(const std::string& scene)
{
    if (fs::is_regular_file(scene)) return scene;
    const fs::path supplied = fs::path(TALUS_SCENARIOS_FOLDER) / (scene + ".toml");
    if (fs::is_regular_file(supplied)) return supplied;

    std::vector<std::string> names;
    for (const fs::path& path : supplied_scenes()) names.push_back(path.stem());
    throw UsageError(
        fmt::format("there is no scene '{}': it is neither a file nor one of {}", scene, fmt::join(names, ", ")));
}

SceneFile read_scene_as_asked(const fs::path& path, const SceneRequest& request)
{
    SceneFile file = read_scene(path, request.overrides);
    if (request.seed) file.scene.seed = *request.seed;
    if (request.until) file.scene.time.duration = *request.until;
    return file;
}

OpenedScene build_opened(SceneFile file, std::string name)
{
    try {
        auto [simulation, report] = build_scene(file.scene);
        return {std::move(name), std::move(file.scene), std::move(simulation), std::move(report)};
    } catch (const SceneError& error) {
        const std::string first =
            error.first_key.empty() ? "" : fmt::format("; the first is at {}", file.place_of(error.first_key));
        throw InputError(fmt::format("{}: {}{}", file.place_of(error.key), error.what(), first));
    }
}

OpenedScene open_scene(const SceneRequest& request)
{
    const fs::path path = scene_path(request.scene);
    return build_opened(read_scene_as_asked(path, request), path.stem());
}

void warn_unless_protected(const FolderLock& lock)
{
    if (!lock.protects())
        warn("{}: this file system knows no locks; nothing keeps a second run or resume from writing here\n",
            lock.folder().string());
}

std::vector<fs::path> supplied_scenes()
{
    std::vector<fs::path> scenes;
    for (const auto& entry : fs::directory_iterator(TALUS_SCENARIOS_FOLDER))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

} // namespace talus
