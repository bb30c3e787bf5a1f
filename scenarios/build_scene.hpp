// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"
#include "scenarios/simulation.hpp"

#include <stdexcept>
#include <string>

namespace talus
{

/// A scene that cannot be built. `key` is the path of the offending key ("fill[0].region", "wall[2].material"), by
/// which the reader of the file finds line and column; what() is a sentence without file or line.
struct SceneError : std::runtime_error {
    SceneError(std::string key_path, const std::string& sentence)
        : std::runtime_error(sentence), key(std::move(key_path))
    {
    }
    std::string key;
};

/// Builds the simulation that a scene describes. The meshes of its walls must have been read (WallTable::triangles).
/// @throws SceneError
Simulation build_scene(const scene::Scene& scene);

} // namespace talus
