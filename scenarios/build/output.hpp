// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/output_choice.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// @throws SceneError where the region is empty
OutputChoice build_output(const scene::Scene& scene);

} // namespace talus
