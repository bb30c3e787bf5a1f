// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/open_scene.hpp"

#include "app/system/own_files.hpp"
#include "app/system/terminal.hpp"
#include "io/scene/accuracy_file.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/build_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace talus
{

namespace fs = std::filesystem;

namespace
{

/// @param otherwise what to say before the names of the scenes that there are
fs::path supplied_scene(const std::string& name, const std::string& otherwise)
{
    std::vector<std::string> names;
    for (const fs::path& path : supplied_scenes()) {
        if (path.stem() == name) return path;
        names.push_back(path.stem());
    }
    throw UsageError(fmt::format("there is no scene '{}': it is {} {}", name, otherwise, fmt::join(names, ", ")));
}

} // namespace

fs::path scene_path(const std::string& scene)
{
    return fs::is_regular_file(scene) ? fs::path(scene) : supplied_scene(scene, "neither a file nor one of");
}

fs::path supplied_scene(const std::string& name)
{
    return supplied_scene(name, "none of those that come with Talus:");
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
    if (!file.scene.accuracy.empty())
        file.scene.measured = read_measured_settings(own_files() / "scenarios" / "accuracy" / "settings.toml");
    try {
        auto [simulation, report, output] = build_scene(file.scene);
        return {std::move(name), std::move(file.path), std::move(file.scene), std::move(simulation), std::move(report),
            std::move(output)};
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

std::vector<fs::path> inputs_of(const OpenedScene& opened, const std::vector<NamedFile>& named)
{
    std::vector<fs::path> inputs = {opened.path};
    for (const NamedFile& file : named) inputs.emplace_back(file.path);
    return inputs;
}

void warn_unless_protected(const FolderLock& lock)
{
    if (!lock.protects())
        warn("{}: this file system knows no locks; nothing keeps a second run or resume from writing here\n",
            lock.folder().string());
}

std::vector<fs::path> supplied_scenes()
{
    const fs::path folder = own_files() / "scenarios";
    std::error_code error;
    std::vector<fs::path> scenes;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    if (error) throw UsageError(fmt::format("the scenes of Talus are not in {}: {}", folder.string(), error.message()));
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

} // namespace talus
