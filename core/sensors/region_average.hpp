// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/block_mean.hpp"
#include "core/base/region.hpp"
#include "core/sensors/sensor.hpp"

#include <array>

namespace talus
{

/// What the spheres in a region do on average. Every sphere counts with the share w of its volume that lies inside
/// (region_share.hpp); overlaps count twice, V is the volume of the region.
///
/// - packing fraction Σ w V_i / V
/// - coordination number Σ w c / Σ w, c the contacts of a sphere that carry an impulse, those with walls included; and
///   the same over the spheres that have two contacts or more (not rattlers)
/// - mean velocity u = Σ w m v / Σ w m [m/s]
/// - granular temperature Σ w m |v − u|² / (3 Σ w m) [m²/s²]; a gradient of the mean velocity across the region is
///   in it
/// - stress, symmetric part, compression positive [Pa]: that of the contacts (Love 1927, Weber 1966; of each branch the
///   length inside counts, so that the force through every plane of the region is right), and the kinetic part:
///
///       σ = (1/V) Σ_contacts f ⊗ l_inside + (1/V) Σ w m (v − u) ⊗ (v − u)
///
///   f is the force on a, l from b to a, at a wall from where the sphere touches it
/// - pressure tr σ / 3 [Pa]
///
/// The results are means over the samples in a window of time, with the standard error of block means (block_mean.hpp).
class RegionAverage : public Sensor
{
public:
    RegionAverage(std::string name, const Region& region, const TimeWindow& window);

    void sample(const Snapshot& now) override;
    std::vector<Measurement> latest() const override;
    std::vector<Measurement> results() const override;
    void persist(Archive& archive) override;

    static constexpr std::size_t quantities = 14;

private:
    Region region_;
    TimeWindow window_;
    std::array<double, quantities> latest_;
    std::array<BlockMean, quantities> means_;
};

} // namespace talus
