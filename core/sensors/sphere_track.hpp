// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"

#include <array>

namespace talus
{

/// Where one sphere is [m], how fast [m/s] and with which spin [rad/s]. The results are those of the last sample.
class SphereTrack : public Sensor
{
public:
    /// @param id of the sphere, which keeps it however spheres are ordered
    SphereTrack(std::string name, std::int64_t id);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override { return latest(); }
    std::string silence() const override;
    void persist(Archive& archive) override { archive(latest_); }

private:
    std::int64_t id_;
    std::array<double, 9> latest_; ///< position, velocity, spin; not numbers while the sphere is not there
};

} // namespace talus
