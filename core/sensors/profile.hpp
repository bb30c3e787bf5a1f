// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/block_mean.hpp"
#include "core/sensors/region_bins.hpp"
#include "core/sensors/sensor.hpp"

#include <array>

namespace talus
{

/// How packing and flow change along one direction of a region: for each bin, over all samples in a window of time and
/// with w the share of a sphere's volume in the bin (region_share.hpp),
///
/// - packing fraction ⟨Σ w V_i / V⟩
/// - mean velocity u = Σ w m v / Σ w m [m/s], by components (region_bins.hpp)
/// - granular temperature (Σ w m v² / Σ w m − u²) / 3 [m²/s²]: about the mean over time, so the flow must be steady
///
/// and for the first two the standard error of block means (block_mean.hpp). That is the table; the named results are
/// packing fraction and mean velocity of the whole region.
class Profile : public Sensor
{
public:
    Profile(std::string name, const RegionBins& bins, const TimeWindow& window);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    std::optional<Table> table() const override;
    void persist(Archive& archive) override;

private:
    /// Sums over the spheres of one sample.
    struct Content {
        double solid_volume = 0.0, mass = 0.0; ///< [m³], [kg]
        Vec3 momentum = Vec3::Zero();          ///< by components [kg m/s]
        double energy = 0.0;                   ///< Σ w m v² [J]

        void add(double sphere_volume, double sphere_mass, const Vec3& velocity);
    };

    /// Means over time, of a bin or of all.
    struct Average {
        BlockMean packing, square_speed; ///< –, [m²/s²]
        std::array<BlockMean, 3> velocity;
        std::int64_t samples = 0; ///< with something in it

        void add(const Content& content, double volume);
        Vec3 mean_velocity() const;
        double granular_temperature() const;
        void persist(Archive& archive);
    };

    RegionBins bins_;
    TimeWindow window_;
    double volume_ = 0.0;          ///< of all bins [m³]
    std::array<double, 4> latest_; ///< packing fraction and mean velocity of the whole region
    std::vector<Average> of_bin_;
    Average of_all_;

    std::string velocity_name(std::size_t component) const;
    std::vector<Measurement> named(const std::array<double, 4>& values, const std::array<double, 4>& spreads) const;
};

} // namespace talus
