// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

namespace talus::test
{

/// Twenty beads of 10 mm above the floor of a box, all of glass: a good scene to be spoilt or grown.
scene::Scene small_scene();

/// A region or wall of these corners.
scene::RegionTable box_region(const Vec3& min, const Vec3& max);

/// A pour of 10 mm beads into the same box.
scene::PourTable small_pour();

scene::SensorTable sensor(const std::string& name, const std::string& kind);

} // namespace talus::test
