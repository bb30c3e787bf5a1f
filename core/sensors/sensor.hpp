// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/block_mean.hpp"
#include "core/contacts/contact_network.hpp"
#include "core/step/time_step.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <optional>
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
    std::optional<double> independent = std::nullopt; ///< samples that are worth so many independent ones, if known
    bool too_few = false; ///< these are so few that the spread is a lower bound (block_mean.hpp)
};

/// A result that is the mean over time.
Measurement measurement(const std::string& name, const BlockMean& mean, const std::string& unit);

/// Results that are too many for names: a row for each place, say.
struct Table {
    struct Column {
        std::string name;
        std::string unit;
    };
    std::vector<Column> columns;
    std::vector<std::vector<double>> rows; ///< as long as there are columns
};

/// The steady part of a run, over which a sensor averages [s].
struct TimeWindow {
    double from = 0.0;
    double to = infinity;

    bool contains(double time) const { return time >= from && time <= to; }
};

/// What a sensor may look at after a step: the spheres as they are, the contacts that the step solved, and its report.
/// They belong together: contacts name spheres by storage index.
struct Snapshot {
    const State& state;
    const Model& model;
    const ContactNetwork& network;
    const StepReport& report;
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

    /// Called after every step, for what must be summed over all of them.
    virtual void watch(const Snapshot&) {}

    /// Takes a sample at the state's time. The run loop calls it at every metrics interval.
    virtual void sample(const Snapshot& now) = 0;

    /// The latest sample, as named values with units (spread 0); the same names and order at every call.
    virtual std::vector<Measurement> latest() const = 0;

    /// The results over all samples so far.
    virtual std::vector<Measurement> results() const = 0;

    /// Why results are not numbers, where some are not.
    virtual std::string silence() const { return "there was nothing to measure"; }

    /// The results that have a file of their own, for the sensors that have some.
    virtual std::optional<Table> table() const { return std::nullopt; }

    /// Stores or puts back what the sensor has seen so far, for checkpoints.
    virtual void persist(Archive& archive) = 0;
};

} // namespace talus
