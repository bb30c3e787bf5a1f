// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/step_watch.hpp"

#include "core/contacts/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr int long_move_steps = 10;     ///< a few fast grains now and then do no harm
constexpr double deep_overlap = 0.05;   ///< diameters
constexpr double wanted_overlap = 0.02; ///< diameters
constexpr int deep_overlap_steps = 200; ///< an impact's overlap is over sooner

/// Rounded down to two digits.
double round_down(double value)
{
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return std::floor(value / unit) * unit;
}

/// ", now sphere 3 and the wall 'lid' most": the bodies of the deepest contact.
std::string deepest_now(const Simulation& simulation)
{
    const State& state = simulation.state;
    double deepest = 0.0;
    std::string who;
    for_each_loaded_sphere_contact(simulation.network, [&](const Contact& c, const ContactGeometry& g) {
        if (-g.gap <= deepest) return;
        deepest = -g.gap;
        who = fmt::format(", now spheres {} and {} most", state.id[c.a], state.id[c.b]);
    });
    for_each_loaded_wall_contact(simulation.network, [&](const Contact& c, const ContactGeometry& g) {
        if (-g.gap <= deepest) return;
        deepest = -g.gap;
        who = fmt::format(", now sphere {} and the wall '{}' most", state.id[c.a], simulation.model.walls[c.b].name);
    });
    return who;
}

} // namespace

std::string StepWatch::warning_after(const StepReport& report, const Simulation* simulation)
{
    const std::string of_moves = warning_of_moves(report);
    return of_moves.empty() ? warning_of_overlap(report, simulation) : of_moves;
}

std::string StepWatch::warning_of_moves(const StepReport& report)
{
    if (move_told_ || report.bodies.long_moves == 0) return "";
    fastest_ = std::max(fastest_, report.bodies.fastest_speed);
    if (++steps_with_long_moves_ < long_move_steps) return "";
    move_told_ = true;
    return fmt::format(
        "spheres have moved over 0.1 d in {} steps, up to {:.3g} m/s fast; steps are split from 0.2 d on, "
        "shorter ones see every impact more closely: --set time.step={:.2g}",
        steps_with_long_moves_, fastest_, round_down(0.1 * model_.min_diameter / fastest_));
}

std::string StepWatch::warning_of_overlap(const StepReport& report, const Simulation* simulation)
{
    if (overlap_told_) return "";
    if (report.contacts.worst_overlap < deep_overlap * model_.mean_diameter) {
        deep_steps_ = 0;
        deepest_ = 0.0;
        return "";
    }
    deepest_ = std::max(deepest_, report.contacts.worst_overlap);
    if (++deep_steps_ < deep_overlap_steps) return "";
    overlap_told_ = true;
    // the stiffness that the sweeps can carry goes with 1/h²
    const double overlap = deepest_ / model_.mean_diameter;
    return fmt::format("spheres have overlapped by up to {:.2g} % d for {} steps{}; contacts are stiffer with shorter "
                       "ones: --set time.step={:.2g}",
        100.0 * overlap, deep_steps_, simulation ? deepest_now(*simulation) : "",
        round_down(model_.time_step * std::sqrt(wanted_overlap / overlap)));
}

} // namespace talus
