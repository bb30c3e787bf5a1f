// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"

namespace talus::test
{

/// Shows a sensor spheres that no step has moved.
inline void sample(Sensor& sensor, const State& state, const Model& model)
{
    const ContactNetwork no_network;
    const StepReport no_step;
    sensor.sample({state, model, no_network, no_step});
}

} // namespace talus::test
