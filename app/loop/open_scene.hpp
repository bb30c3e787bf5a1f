// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/run/folder_lock.hpp"
#include "io/scene/scene_file.hpp"
#include "scenarios/builder/build_report.hpp"
#include "scenarios/output_choice.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace talus
{

/// A scene as the user asks for it.
struct SceneRequest {
    std::string scene;                  ///< a path, or a name in scenarios/
    std::vector<std::string> overrides; ///< key=value
    std::optional<std::int64_t> seed;
    std::optional<double> until; ///< [s]
};

/// A scene that was read and built, ready to run.
struct OpenedScene {
    std::string name; ///< of the file, without folder and ending
    std::filesystem::path path;
    scene::Scene scene;
    Simulation simulation;
    BuildReport report; ///< what there is to report of the simulation as it was built
    OutputChoice output;
};

/// The file of a scene that is given as a path or a name in scenarios/.
/// @throws UsageError where there is no such scene
std::filesystem::path scene_path(const std::string& scene);

/// The file of a scene that comes with Talus.
/// @throws UsageError where there is no such scene
std::filesystem::path supplied_scene(const std::string& name);

/// Finds, reads and builds a scene, with what the request changes in it.
/// @throws InputError with file, line and column; UsageError where there is no such scene
OpenedScene open_scene(const SceneRequest& request);

/// Reads a scene file with what the request changes in it.
/// @throws InputError with file, line and column
SceneFile read_scene_as_asked(const std::filesystem::path& path, const SceneRequest& request);

/// Builds a scene that was read.
/// @throws InputError with file, line and column
OpenedScene build_opened(SceneFile file, std::string name);

/// The files that a scene was read from: its own, and those that it names.
std::vector<std::filesystem::path> inputs_of(const OpenedScene& opened, const std::vector<NamedFile>& named);

/// Says so where a folder cannot be kept from others.
void warn_unless_protected(const FolderLock& lock);

/// The scene files that come with Talus, by name.
/// @throws UsageError where they are not where they belong
std::vector<std::filesystem::path> supplied_scenes();

} // namespace talus
