// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace talus
{

/// A scene as read from a file, with the place of each of its keys.
struct SceneFile {
    scene::Scene scene;
    std::filesystem::path path;
    std::map<std::string, std::string>
        places; ///< key path ("fill[0].region") → "file:line:column" or "--set key=value"

    /// The place of a key, or of the nearest table around it that stands in the file.
    std::string place_of(const std::string& key) const;
};

/// Reads a scene file strictly: an unknown key, a wrong type or a value out of range is refused with file, line,
/// column, the key, what is allowed and the nearest known key. Reads the files that it names: meshes, spheres, sieve
/// analyses.
/// @param overrides "key=value", the value in TOML; a key reaches tables by name ("wall.gate.remove_at",
///   "contact.glass-glass.friction") or by index ("fill.0.count").
/// @throws InputError
SceneFile read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

/// The same from a text.
/// @param path what stands for the file in sentences, and whose folder the files lie in that it names
/// @throws InputError
SceneFile read_scene_text(
    const std::string& text, const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

/// Reads a scene from its text, the one of `resolved_scene`, without the STL files that it names.
/// @throws InputError
scene::Scene parse_scene(const std::string& text);

/// The whole scene as TOML, with every key; reading it again gives the same scene.
std::string resolved_scene(const scene::Scene& scene);

/// The keys in which two scenes differ, as in SceneFile::places; where a list of tables has another length, the list.
std::vector<std::string> changed_keys(const scene::Scene& before, const scene::Scene& after);

/// Reads every file that a scene names into it, meshes, spheres and sieve analyses, and makes their paths absolute: a
/// part of read_scene (in named_files.cpp).
/// @throws InputError that begins with the place of the key
void read_named_files(SceneFile& file);

/// A file that a scene was read from beside its own, that of a key `mesh` or `file`.
struct NamedFile {
    std::string path;
    std::string copy;      ///< from a run's folder: "files/hopper.stl"
    std::uint32_t sum = 0; ///< its checksum
};

/// These files, each once.
/// @throws InputError where one cannot be read any more
std::vector<NamedFile> named_files(scene::Scene scene);

/// The scene as it stands in a run's folder, where it names the copies of its files.
scene::Scene with_copies(scene::Scene scene, const std::vector<NamedFile>& files);

} // namespace talus
