// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensor.hpp"

namespace talus::test
{

/// Shows a sensor spheres that no step has moved.
inline void sample(Sensor& sensor, const State& state, const Model& model)
{
    sensor.sample({state, model, ContactNetwork{}, StepReport{}});
}

} // namespace talus::test
