// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/region_average.hpp"

#include "core/contacts/loads.hpp"
#include "core/sensors/region_share.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace talus
{
namespace
{

using Tensor = Eigen::Matrix3d;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::int32_t least_contacts = 2; ///< of a sphere that is no rattler

struct Quantity {
    const char* name;
    const char* unit;
};

constexpr std::array<Quantity, RegionAverage::quantities> quantity = {{{"packing_fraction", "1"}, {"coordination", "1"},
    {"coordination_without_rattlers", "1"}, {"velocity_x", "m/s"}, {"velocity_y", "m/s"}, {"velocity_z", "m/s"},
    {"granular_temperature", "m2/s2"}, {"stress_xx", "Pa"}, {"stress_yy", "Pa"}, {"stress_zz", "Pa"},
    {"stress_yz", "Pa"}, {"stress_xz", "Pa"}, {"stress_xy", "Pa"}, {"pressure", "Pa"}}};

/// Sums over the spheres, each by its share inside the region.
struct Content {
    double spheres = 0.0, contacts = 0.0;        ///< Σ w, Σ w c
    double backbone = 0.0, backbone_links = 0.0; ///< the same without rattlers
    double solid_volume = 0.0, mass = 0.0;       ///< [m³], [kg]
    Vec3 momentum = Vec3::Zero();                ///< [kg m/s]
    Tensor flux = Tensor::Zero();                ///< Σ w m v ⊗ v [J]

    Vec3 velocity() const { return momentum / mass; }

    /// Σ w m (v − u) ⊗ (v − u) [J].
    Tensor fluctuation() const
    {
        if (mass == 0.0) return Tensor::Zero();
        return flux - momentum * velocity().transpose();
    }
};

Content content_of(const Region& region, const Snapshot& now)
{
    const State& state = now.state;
    const auto loads = sphere_loads(now.network, state.count());
    const auto images = now.model.periodicity.neighbor_shifts();
    Content content;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const double r = state.radius[i];
        double share = 0.0;
        for (const Vec3& shift : images) share += ball_share(region, state.position[i] + shift, r);
        if (share == 0.0) continue;
        const double mass = share * state.mass(i);
        const Vec3& v = state.body(i).velocity;
        content.spheres += share;
        content.contacts += share * loads[i].contacts;
        if (loads[i].contacts >= least_contacts) {
            content.backbone += share;
            content.backbone_links += share * loads[i].contacts;
        }
        content.solid_volume += share * 4.0 / 3.0 * std::numbers::pi * r * r * r;
        content.mass += mass;
        content.momentum += mass * v;
        content.flux += mass * v * v.transpose();
    }
    return content;
}

/// Σ f ⊗ l over the contacts of the step, l the part of the branch inside [J]. Each half of a branch is laid out from
/// its own sphere, so that it is in the right place wherever the other one is kept.
Tensor contact_virial(const Region& region, const Snapshot& now)
{
    const State& state = now.state;
    const auto images = now.model.periodicity.neighbor_shifts();
    Tensor virial = Tensor::Zero();
    const auto inside = [&](std::int32_t sphere, const Vec3& branch) {
        double share = 0.0;
        for (const Vec3& shift : images) {
            const Vec3 x = state.position[sphere] + shift;
            share += segment_share(region, x, x + branch);
        }
        return share * branch.norm();
    };
    for_each_loaded_sphere_contact(now.network, [&](const Contact& c) {
        const double length = inside(c.a, -(state.radius[c.a] + 0.5 * c.gap) * c.normal) +
                              inside(c.b, (state.radius[c.b] + 0.5 * c.gap) * c.normal);
        virial += length * c.impulse * c.normal.transpose();
    });
    for_each_loaded_wall_contact(now.network, [&](const Contact& c) {
        virial += inside(c.a, -(state.radius[c.a] + c.gap) * c.normal) * c.impulse * c.normal.transpose();
    });
    return virial / now.network.carried.impulse_step;
}

} // namespace

RegionAverage::RegionAverage(std::string sensor_name, const Region& region, const TimeWindow& window)
    : Sensor(std::move(sensor_name)), region_(region), window_(window)
{
    latest_.fill(nothing);
}

void RegionAverage::sample(const Snapshot& now)
{
    const Content content = content_of(region_, now);
    const Tensor fluctuation = content.fluctuation();
    const Tensor virial = contact_virial(region_, now);
    const Tensor stress = (0.5 * (virial + virial.transpose()) + fluctuation) / region_.volume();
    const Vec3 u = content.velocity();
    latest_ = {content.solid_volume / region_.volume(), content.contacts / content.spheres,
        content.backbone_links / content.backbone, u.x(), u.y(), u.z(), fluctuation.trace() / (3.0 * content.mass),
        stress(0, 0), stress(1, 1), stress(2, 2), stress(1, 2), stress(0, 2), stress(0, 1), stress.trace() / 3.0};
    if (!window_.contains(now.state.time)) return;

    // In the mean over time a sphere weighs the same whenever it is seen; stress and packing belong to the region.
    std::array<double, quantities> weight;
    weight.fill(1.0);
    weight[1] = content.spheres;
    weight[2] = content.backbone;
    for (std::size_t k = 3; k <= 6; ++k) weight[k] = content.mass;
    for (std::size_t k = 0; k < quantities; ++k) means_[k].add(latest_[k], weight[k]);
}

std::vector<Measurement> RegionAverage::latest() const
{
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < quantities; ++k) all.push_back({quantity[k].name, latest_[k], 0.0, quantity[k].unit});
    return all;
}

std::vector<Measurement> RegionAverage::results() const
{
    const bool never_held = std::isnan(means_[3].mean()); // a velocity, which weighs as much as the region holds
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < quantities; ++k)
        all.push_back(never_held ? Measurement{quantity[k].name, nothing, nothing, quantity[k].unit}
                                 : measurement(quantity[k].name, means_[k], quantity[k].unit));
    return all;
}

void RegionAverage::persist(Archive& archive)
{
    archive(latest_);
    for (BlockMean& mean : means_) archive(mean);
}

} // namespace talus
