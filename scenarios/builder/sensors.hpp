// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"
#include "core/world/wall.hpp"
#include "scenarios/scene.hpp"

#include <memory>
#include <vector>

namespace talus
{

/// The sensors in the order of the scene. @throws SceneError where one has nothing to measure
std::vector<std::unique_ptr<Sensor>> build_sensors(const scene::Scene& scene, const Model& model);

} // namespace talus
