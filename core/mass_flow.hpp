// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensor.hpp"

namespace talus
{

/// Mass flow through a plane: how fast the mass that was inserted and is no longer behind the plane grows. Spheres that
/// left through an outlet have passed, wherever the outlet is.
///
/// The rate is the least-squares slope of the passed mass over [from, to]; its spread is the standard error of the
/// slopes of five equal parts of that window.
class MassFlow : public Sensor
{
public:
    /// @param normal unit, the direction of the flow; @param from, to the steady window [s]
    MassFlow(std::string name, const Vec3& point, const Vec3& normal, double from, double to);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    void persist(Archive& archive) override { archive(samples_); }

private:
    struct Sample {
        double time, mass, count;
    };
    Vec3 point_, normal_;
    double from_, to_;
    std::vector<Sample> samples_;
};

} // namespace talus
