// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/simulation.hpp"

#include <string>
#include <vector>

namespace talus::test
{

/// The scene of this name in tests/hard/scenes, tests/validation/scenes or scenarios/, with overrides as for `talus run
/// --set`.
Simulation open_scene(const std::string& name, const std::vector<std::string>& overrides = {});

/// Runs until the given time, sampling the sensors every 5 ms. Requires that nothing escapes.
/// @return the fastest speed that a sphere had [m/s]
double run_until(Simulation& simulation, double time);

/// A result of a sensor by the sensor's and the quantity's name.
Measurement result(const Simulation& simulation, const std::string& sensor, const std::string& quantity);

} // namespace talus::test
