// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

#include <string>
#include <vector>

namespace talus
{

/// A result with its spread (standard error of the mean unless the sensor says otherwise).
struct Measurement {
    std::string name; ///< of the quantity; together with the sensor's name it is unique
    double value = 0.0;
    double spread = 0.0;
    std::string unit;
};

/// Something that a scene measures while it runs. It reads the state and never changes it.
class Sensor
{
public:
    explicit Sensor(std::string sensor_name) : name(std::move(sensor_name)) {}
    virtual ~Sensor() = default;
    Sensor(const Sensor&) = delete;
    Sensor& operator=(const Sensor&) = delete;

    const std::string name;

    /// Takes a sample at the state's time. The run loop calls it at every metrics interval.
    virtual void sample(const State& state, const Model& model) = 0;

    /// The latest sample, as named values with units (spread 0); the same names and order at every call.
    virtual std::vector<Measurement> latest() const = 0;

    /// The results over all samples so far.
    virtual std::vector<Measurement> results() const = 0;
};

} // namespace talus
