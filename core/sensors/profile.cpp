// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/profile.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace talus
{

void Profile::Content::add(double sphere_volume, double sphere_mass, const Vec3& velocity)
{
    solid_volume += sphere_volume;
    mass += sphere_mass;
    momentum += sphere_mass * velocity;
    energy += sphere_mass * velocity.squaredNorm();
}

void Profile::Average::add(const Content& content, double volume)
{
    packing.add(content.solid_volume / volume);
    square_speed.add(content.energy / content.mass, content.mass);
    for (std::size_t k = 0; k < 3; ++k)
        velocity[k].add(content.momentum[static_cast<int>(k)] / content.mass, content.mass);
    samples += content.mass > 0.0;
}

Vec3 Profile::Average::mean_velocity() const
{
    return {velocity[0].mean(), velocity[1].mean(), velocity[2].mean()};
}

double Profile::Average::granular_temperature() const
{
    return std::max(square_speed.mean() - mean_velocity().squaredNorm(), 0.0) / 3.0; // not a number stays so
}

void Profile::Average::persist(Archive& archive)
{
    archive(packing, square_speed, velocity[0], velocity[1], velocity[2], samples);
}

Profile::Profile(std::string sensor_name, const RegionBins& bins, const TimeWindow& window)
    : Sensor(std::move(sensor_name)), bins_(bins), window_(window), of_bin_(bins.count())
{
    latest_.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t bin = 0; bin < bins.count(); ++bin) volume_ += bins.volume(bin);
}

void Profile::sample(const Snapshot& now)
{
    const State& state = now.state;
    Content all;
    std::vector<Content> contents(bins_.count());
    const auto images = now.model.periodicity.neighbor_shifts();
    for (std::size_t i = 0; i < state.count(); ++i) {
        const double r = state.radius[i], sphere_volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
        for (const Vec3& shift : images) {
            const Vec3 x = state.position[i] + shift, v = bins_.components(x, state.body(i).velocity);
            bins_.for_each_share(x, r, [&](std::size_t bin, double share) {
                contents[bin].add(share * sphere_volume, share * state.mass(i), v);
                all.add(share * sphere_volume, share * state.mass(i), v);
            });
        }
    }
    const Vec3 u = all.momentum / all.mass;
    latest_ = {all.solid_volume / volume_, u.x(), u.y(), u.z()};
    if (!window_.contains(state.time)) return;
    of_all_.add(all, volume_);
    for (std::size_t bin = 0; bin < bins_.count(); ++bin) of_bin_[bin].add(contents[bin], bins_.volume(bin));
}

std::string Profile::velocity_name(std::size_t component) const
{
    return std::string("velocity_") + bins_.component_names()[component];
}

std::vector<Measurement> Profile::named(const std::array<double, 4>& values, const std::array<double, 4>& spreads) const
{
    std::vector<Measurement> all = {{"packing_fraction", values[0], spreads[0], "1"}};
    for (std::size_t k = 0; k < 3; ++k) all.push_back({velocity_name(k), values[k + 1], spreads[k + 1], "m/s"});
    return all;
}

std::vector<Measurement> Profile::latest() const
{
    return named(latest_, {});
}

std::vector<Measurement> Profile::results() const
{
    std::vector<Measurement> all = {measurement("packing_fraction", of_all_.packing, "1")};
    for (std::size_t k = 0; k < 3; ++k) all.push_back(measurement(velocity_name(k), of_all_.velocity[k], "m/s"));
    return all;
}

std::optional<Table> Profile::table() const
{
    Table table;
    table.columns = {{"position", "m"}, {"packing_fraction", "1"}, {"packing_fraction_error", "1"}};
    for (std::size_t k = 0; k < 3; ++k) {
        table.columns.push_back({velocity_name(k), "m/s"});
        table.columns.push_back({velocity_name(k) + "_error", "m/s"});
    }
    table.columns.push_back({"granular_temperature", "m2/s2"});
    table.columns.push_back({"samples", "1"});
    for (std::size_t bin = 0; bin < bins_.count(); ++bin) {
        const Average& of = of_bin_[bin];
        std::vector<double> row = {bins_.middle(bin), of.packing.mean(), of.packing.error().error};
        for (const BlockMean& component : of.velocity) {
            row.push_back(component.mean());
            row.push_back(component.error().error);
        }
        row.push_back(of.granular_temperature());
        row.push_back(static_cast<double>(of.samples));
        table.rows.push_back(std::move(row));
    }
    return table;
}

void Profile::persist(Archive& archive)
{
    archive(latest_, of_bin_, of_all_);
    if (of_bin_.size() != bins_.count()) throw ArchiveError("the saved profile has another number of bins");
}

} // namespace talus
