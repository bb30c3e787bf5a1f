// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/mass_flow.hpp"

#include <utility>

namespace talus
{

MassFlow::MassFlow(std::string sensor_name, const Vec3& point, const Vec3& normal, const TimeWindow& window)
    : Sensor(std::move(sensor_name)), point_(point), normal_(normal), window_(window)
{
}

double MassFlow::cell_length(const Periodicity& periodicity) const
{
    int axis = 0;
    normal_.cwiseAbs().maxCoeff(&axis);
    return periodicity.length[axis];
}

void MassFlow::watch(const Snapshot& now)
{
    const double length = cell_length(now.model.periodicity);
    if (length == infinity) return;
    for (const auto& m : now.state.bodies) {
        const double passed = normal_.dot(m.velocity) * now.model.time_step / length;
        flowed_mass_ += passed / m.inverse_mass;
        flowed_count_ += passed;
    }
}

MassFlow::Passed MassFlow::passed_so_far(const Snapshot& now) const
{
    const State& state = now.state;
    if (cell_length(now.model.periodicity) < infinity) return {state.time, flowed_mass_, flowed_count_};
    double behind = 0.0;
    std::int64_t behind_count = 0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (normal_.dot(state.position[i] - point_) > 0.0) continue;
        behind += state.mass(i);
        ++behind_count;
    }
    return {state.time, state.inserted_mass - behind, static_cast<double>(state.next_id - behind_count)};
}

void MassFlow::sample(const Snapshot& now)
{
    const Passed before = std::exchange(passed_, passed_so_far(now));
    if (!window_.contains(before.time) || !window_.contains(passed_.time)) return;
    const double span = passed_.time - before.time;
    mass_flow_.add((passed_.mass - before.mass) / span, span);
    sphere_flow_.add((passed_.count - before.count) / span, span);
}

std::vector<Measurement> MassFlow::latest() const
{
    return {{"passed_mass", passed_.mass, 0.0, "kg"}, {"passed_count", passed_.count, 0.0, "1"}};
}

std::vector<Measurement> MassFlow::results() const
{
    return {measurement("mass_flow", mass_flow_, "kg/s"), measurement("sphere_flow", sphere_flow_, "1/s")};
}

} // namespace talus
