// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/repose.hpp"

#include "core/base/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace talus
{
namespace
{

constexpr std::size_t sectors = 16;
constexpr std::size_t octants = 8;
constexpr double empty_sector = -infinity;

/// The highest sphere top in each ring and sector, as heights above the base.
struct Surface {
    double ring_width = 0.0;
    std::vector<std::array<double, sectors>> top; ///< by ring; `empty_sector` where there is no sphere

    /// Mean height of some sectors of a ring; not a number where all are empty.
    double ring_mean(std::size_t ring, std::size_t first_sector, std::size_t count) const
    {
        MeanAndError mean;
        for (std::size_t s = first_sector; s < first_sector + count; ++s) mean.add(top[ring][s]);
        return mean.mean();
    }

    double radius(std::size_t ring) const { return (static_cast<double>(ring) + 0.5) * ring_width; }
};

/// Faster than anything that lies.
double moving_speed(const Model& model)
{
    return 0.3 * std::sqrt(model.gravity.norm() * model.mean_diameter);
}

double moving_share(const State& state, double fast)
{
    double moving = 0.0, all = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        all += state.mass(i);
        if (state.body(i).velocity.norm() > fast) moving += state.mass(i);
    }
    return all > 0.0 ? moving / all : 0.0;
}

/// @param fast spheres above this speed are left out [m/s]
Surface find_surface(const State& state, const Vec3& base, const Vec3& up, double ring_width, double fast)
{
    Surface surface{ring_width, {}};
    const Vec3 e1 = any_perpendicular(up);
    const Vec3 e2 = up.cross(e1);
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (state.body(i).velocity.norm() > fast) continue;
        const Vec3 x = state.position[i] - base;
        const double height = x.dot(up) + state.radius[i];
        const double out = (x - x.dot(up) * up).norm();
        const auto ring = static_cast<std::size_t>(out / ring_width);
        const double turn = std::atan2(x.dot(e2), x.dot(e1)) / (2.0 * std::numbers::pi) + 0.5;
        const auto sector = std::min(sectors - 1, static_cast<std::size_t>(turn * static_cast<double>(sectors)));
        if (height <= 0.0 || ring > 100000) continue; // spheres that have fallen off, or fly far away
        if (ring >= surface.top.size()) {
            std::array<double, sectors> empty;
            empty.fill(empty_sector);
            surface.top.resize(ring + 1, empty);
        }
        surface.top[ring][sector] = std::max(surface.top[ring][sector], height);
    }
    return surface;
}

/// The distance from the axis within which 99 % of the mass lies [m].
double find_foot(const State& state, const Vec3& base, const Vec3& up)
{
    std::vector<std::pair<double, double>> mass_at; // distance, mass
    double mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const Vec3 x = state.position[i] - base;
        mass_at.emplace_back((x - x.dot(up) * up).norm(), state.mass(i));
        mass += state.mass(i);
    }
    std::sort(mass_at.begin(), mass_at.end());
    double within = 0.0;
    for (const auto& [distance, m] : mass_at)
        if ((within += m) >= 0.99 * mass) return distance;
    return 0.0;
}

struct Flank {
    double angle;       ///< [degree]
    std::int64_t rings; ///< that have spheres in these sectors
};

/// The line through the ring means between two radii, over some sectors.
Flank fit_flank(const Surface& surface, double inner, double outer, std::size_t first_sector, std::size_t count)
{
    LineFit line;
    std::int64_t rings = 0;
    for (std::size_t ring = 0; ring < surface.top.size(); ++ring) {
        const double mean = surface.ring_mean(ring, first_sector, count);
        if (surface.radius(ring) < inner || surface.radius(ring) > outer || !std::isfinite(mean)) continue;
        line.add(surface.radius(ring), mean);
        ++rings;
    }
    return {line.fall_angle(), rings};
}

} // namespace

Repose::Repose(std::string sensor_name, const Vec3& base, double inner_radius, double outer_radius)
    : Sensor(std::move(sensor_name)), base_(base), inner_radius_(inner_radius), outer_radius_(outer_radius)
{
}

void Repose::sample(const Snapshot& now)
{
    const Vec3 up = -now.model.gravity.normalized();
    const double fast = moving_speed(now.model);
    const auto surface = find_surface(now.state, base_, up, now.model.mean_diameter, fast);
    moving_ = moving_share(now.state, fast);
    foot_ = find_foot(now.state, base_, up);
    apex_ = 0.0;
    for (std::size_t ring = 0; ring < surface.top.size(); ++ring) {
        const double mean = surface.ring_mean(ring, 0, sectors);
        if (std::isfinite(mean)) apex_ = std::max(apex_, mean);
    }
    double inner = inner_radius_, outer = outer_radius_;
    if (outer == 0.0) {
        // From the last ring above 80 % of the height to the first below 20 %.
        inner = 0.0;
        outer = infinity;
        for (std::size_t ring = 0; ring < surface.top.size(); ++ring) {
            const double mean = surface.ring_mean(ring, 0, sectors);
            if (mean > 0.8 * apex_) inner = surface.radius(ring);
            if (mean < 0.2 * apex_) outer = std::min(outer, surface.radius(ring));
        }
    }
    height_ = apex_ / now.model.mean_diameter;
    const Flank flank = fit_flank(surface, inner, outer, 0, sectors);
    angle_ = flank.angle;
    rings_ = flank.rings;
    MeanAndError angles;
    constexpr std::size_t width = sectors / octants;
    for (std::size_t k = 0; k < octants; ++k) angles.add(fit_flank(surface, inner, outer, k * width, width).angle);
    spread_ = angles.standard_error();
}

std::vector<Measurement> Repose::latest() const
{
    return {{"angle", angle_, 0.0, "deg"}, {"apex", apex_, 0.0, "m"}, {"foot", foot_, 0.0, "m"}};
}

std::vector<Measurement> Repose::results() const
{
    return {{"angle", is_heap() ? angle_ : nothing_yet, is_heap() ? spread_ : nothing_yet, "deg"},
        {"apex", apex_, 0.0, "m"}, {"foot", foot_, 0.0, "m"}};
}

std::string Repose::silence() const
{
    char text[100];
    if (moving_ > most_moving)
        std::snprintf(text, sizeof text, "no heap: %.0f %% of the mass falls or flows", 100.0 * moving_);
    else if (height_ < least_height)
        std::snprintf(text, sizeof text, "no heap: it is %.2g diameters high", height_);
    else
        std::snprintf(text, sizeof text, "no heap: its flank is %d diameters wide", static_cast<int>(rings_));
    return text;
}

} // namespace talus
