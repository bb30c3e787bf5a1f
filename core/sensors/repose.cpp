// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/repose.hpp"

#include "core/base/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace talus
{
namespace
{

constexpr std::size_t sectors = 16;
constexpr std::size_t octants = 8;
constexpr double nothing = -infinity;

/// The highest sphere top in each ring and sector, as heights above the base.
struct Surface {
    double ring_width = 0.0;
    std::vector<std::array<double, sectors>> top; ///< by ring; `nothing` where there is no sphere

    /// Mean height of some sectors of a ring; not a number where all are empty.
    double ring_mean(std::size_t ring, std::size_t first_sector, std::size_t count) const
    {
        MeanAndError mean;
        for (std::size_t s = first_sector; s < first_sector + count; ++s) mean.add(top[ring][s]);
        return mean.mean();
    }

    double radius(std::size_t ring) const { return (static_cast<double>(ring) + 0.5) * ring_width; }
};

Surface find_surface(const State& state, const Vec3& base, const Vec3& up, double ring_width)
{
    Surface surface{ring_width, {}};
    const Vec3 e1 = any_perpendicular(up);
    const Vec3 e2 = up.cross(e1);
    for (std::size_t i = 0; i < state.count(); ++i) {
        const Vec3 x = state.position[i] - base;
        const double height = x.dot(up) + state.radius(i);
        const double out = (x - x.dot(up) * up).norm();
        const auto ring = static_cast<std::size_t>(out / ring_width);
        const double turn = std::atan2(x.dot(e2), x.dot(e1)) / (2.0 * std::numbers::pi) + 0.5;
        const auto sector = std::min(sectors - 1, static_cast<std::size_t>(turn * static_cast<double>(sectors)));
        if (height <= 0.0 || ring > 100000) continue; // spheres that have fallen off, or fly far away
        if (ring >= surface.top.size()) {
            std::array<double, sectors> empty;
            empty.fill(nothing);
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

/// Slope angle [degree] of the line through the ring means between two radii, over some sectors.
double slope_angle(const Surface& surface, double inner, double outer, std::size_t first_sector, std::size_t count)
{
    LineFit line;
    for (std::size_t ring = 0; ring < surface.top.size(); ++ring) {
        const double mean = surface.ring_mean(ring, first_sector, count);
        if (surface.radius(ring) >= inner && surface.radius(ring) <= outer && std::isfinite(mean))
            line.add(surface.radius(ring), mean);
    }
    return line.fall_angle();
}

} // namespace

Repose::Repose(std::string sensor_name, const Vec3& base, double inner_radius, double outer_radius)
    : Sensor(std::move(sensor_name)), base_(base), inner_radius_(inner_radius), outer_radius_(outer_radius)
{
}

void Repose::sample(const Snapshot& now)
{
    const Vec3 up = -now.model.gravity.normalized();
    const auto surface = find_surface(now.state, base_, up, now.model.mean_diameter);
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
    angle_ = slope_angle(surface, inner, outer, 0, sectors);
    MeanAndError angles;
    constexpr std::size_t width = sectors / octants;
    for (std::size_t k = 0; k < octants; ++k) angles.add(slope_angle(surface, inner, outer, k * width, width));
    spread_ = angles.standard_error();
}

std::vector<Measurement> Repose::latest() const
{
    return {{"angle", angle_, 0.0, "deg"}, {"apex", apex_, 0.0, "m"}, {"foot", foot_, 0.0, "m"}};
}

std::vector<Measurement> Repose::results() const
{
    return {{"angle", angle_, spread_, "deg"}, {"apex", apex_, 0.0, "m"}, {"foot", foot_, 0.0, "m"}};
}

} // namespace talus
