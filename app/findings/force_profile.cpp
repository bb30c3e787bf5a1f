// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/findings/force_profile.hpp"

#include "core/contacts/loads.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{

ForceProfile::ForceProfile(const State& state, const Vec3& up, std::size_t cuts) : up_(up), cuts_(cuts)
{
    double foot = infinity, top = -infinity;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const double height = up.dot(state.position[i]);
        foot = std::min(foot, height - state.radius[i]);
        top = std::max(top, height + state.radius[i]);
    }
    if (state.count() == 0) return;
    foot_ = foot;
    spacing_ = (top - foot) / static_cast<double>(cuts + 1);
}

std::vector<double> ForceProfile::forces(
    const State& state, const ContactNetwork& network, const StepReport& report, double time_step) const
{
    std::vector<double> impulse(cuts_ + 1);
    impulse[0] = report.outcome.from_walls.impulse.dot(up_);
    // Cut k = 1, 2, … is at foot + k spacing: how many of them lie below a centre.
    const auto cuts_below = [&](std::int32_t sphere) {
        const double height = up_.dot(state.position[static_cast<std::size_t>(sphere)]) - foot_;
        return static_cast<std::size_t>(std::clamp(std::floor(height / spacing_), 0.0, static_cast<double>(cuts_)));
    };
    for_each_loaded_sphere_contact(network, [&](const Contact& c) {
        const std::size_t a = cuts_below(c.a), b = cuts_below(c.b);
        const double lift = (a > b ? 1.0 : -1.0) * c.impulse.dot(up_); // on the upper of the two
        for (std::size_t k = std::min(a, b) + 1; k <= std::max(a, b); ++k) impulse[k] += lift;
    });
    // The contacts are those of the last sub-step, the walls' impulse is that of the whole step.
    for (std::size_t k = 0; k < impulse.size(); ++k) impulse[k] /= k == 0 ? time_step : network.carried.impulse_step;
    return impulse;
}

} // namespace talus
