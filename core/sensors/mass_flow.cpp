// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/mass_flow.hpp"

#include "core/base/statistics.hpp"

#include <algorithm>

namespace talus
{
namespace
{

constexpr int parts = 5; ///< of the steady window, for the spread

} // namespace

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
    for (const auto& m : now.state.motion) {
        const double passed = normal_.dot(m.velocity) * now.model.time_step / length;
        flowed_mass_ += passed / m.inverse_mass;
        flowed_count_ += passed;
    }
}

void MassFlow::sample(const Snapshot& now)
{
    const State& state = now.state;
    if (cell_length(now.model.periodicity) < infinity) {
        samples_.push_back({state.time, flowed_mass_, flowed_count_});
        return;
    }
    double behind = 0.0;
    std::int64_t behind_count = 0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (normal_.dot(state.position[i] - point_) > 0.0) continue;
        behind += state.mass(i);
        ++behind_count;
    }
    samples_.push_back({state.time, state.inserted_mass - behind, static_cast<double>(state.next_id - behind_count)});
}

std::vector<Measurement> MassFlow::latest() const
{
    const Sample last = samples_.empty() ? Sample{} : samples_.back();
    return {{"passed_mass", last.mass, 0.0, "kg"}, {"passed_count", last.count, 0.0, "1"}};
}

std::vector<Measurement> MassFlow::results() const
{
    LineFit mass, count;
    std::vector<Sample> steady;
    std::copy_if(samples_.begin(), samples_.end(), std::back_inserter(steady),
        [&](const Sample& s) { return window_.contains(s.time); });
    std::vector<LineFit> mass_part(parts), count_part(parts);
    for (std::size_t k = 0; k < steady.size(); ++k) {
        mass.add(steady[k].time, steady[k].mass);
        count.add(steady[k].time, steady[k].count);
        const auto part = k * parts / steady.size();
        mass_part[part].add(steady[k].time, steady[k].mass);
        count_part[part].add(steady[k].time, steady[k].count);
    }
    MeanAndError mass_slopes, count_slopes;
    for (std::size_t p = 0; p < parts; ++p) {
        mass_slopes.add(mass_part[p].slope());
        count_slopes.add(count_part[p].slope());
    }
    return {{"mass_flow", mass.slope(), mass_slopes.standard_error(), "kg/s"},
        {"sphere_flow", count.slope(), count_slopes.standard_error(), "1/s"}};
}

} // namespace talus
