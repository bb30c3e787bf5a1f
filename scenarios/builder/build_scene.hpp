// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/builder/build_report.hpp"
#include "scenarios/output_choice.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/scene_error.hpp"

namespace talus
{

/// A simulation ready to run, and what there is to tell of it.
struct BuiltScene {
    Simulation simulation;
    BuildReport report;
    OutputChoice output;
};

/// Builds the simulation that a scene describes. The meshes of its walls must have been read (WallTable::triangles).
/// @throws SceneError
BuiltScene build_scene(const scene::Scene& scene);

} // namespace talus
