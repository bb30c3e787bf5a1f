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

constexpr std::size_t octants = 8;
constexpr double rings_per_diameter = 2.0;
constexpr double cells_per_diameter = 3.0;
constexpr double most_cells_across = 1024.0; ///< of the grid; of larger heaps it has larger cells

/// What every cell of a square grid round the axis holds of a heap's surface.
class Surface
{
public:
    /// @param base centre of the floor [m]; @param up unit; @param foot how far the heap reaches [m]
    Surface(const Vec3& base, const Vec3& up, double diameter, double foot)
        : base_(base), up_(up), e1_(any_perpendicular(up)), e2_(up.cross(e1_)), diameter_(diameter),
          half_(foot + diameter), cell_(std::max(diameter / cells_per_diameter, 2.0 * half_ / most_cells_across)),
          cells_(static_cast<Eigen::Index>(std::ceil(2.0 * half_ / cell_))),
          height_(Eigen::ArrayXXd::Zero(cells_, cells_))
    {
    }

    /// Raises the surface to where a grain of the mean diameter that is let down meets this sphere.
    void add(const Vec3& position, double radius)
    {
        const Vec3 x = position - base_;
        const double across = x.dot(e1_), along = x.dot(e2_), reach = radius + 0.5 * diameter_;
        const double top = x.dot(up_) - 0.5 * diameter_;
        if (top + reach <= 0.0) return; // it has fallen off
        const auto cell = [&](double place) {
            return std::clamp<Eigen::Index>(
                static_cast<Eigen::Index>((std::clamp(place, -half_, half_) + half_) / cell_), 0, cells_ - 1);
        };
        for (Eigen::Index i = cell(across - reach); i <= cell(across + reach); ++i)
            for (Eigen::Index j = cell(along - reach); j <= cell(along + reach); ++j) {
                const double square = reach * reach - std::pow(place(i) - across, 2) - std::pow(place(j) - along, 2);
                const double below = height_(i, j) - top; // how high the surface is already
                if (square > 0.0 && (below < 0.0 || square > below * below)) height_(i, j) = top + std::sqrt(square);
            }
    }

    /// Calls use(place across and along the base from the axis, height above it) for every cell.
    template <typename Use> void for_each_cell(Use&& use) const
    {
        for (Eigen::Index j = 0; j < cells_; ++j)
            for (Eigen::Index i = 0; i < cells_; ++i) use(place(i), place(j), height_(i, j));
    }

private:
    Vec3 base_, up_, e1_, e2_;
    double diameter_, half_, cell_;
    Eigen::Index cells_;
    Eigen::ArrayXXd height_;

    double place(Eigen::Index k) const { return (static_cast<double>(k) + 0.5) * cell_ - half_; }
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

/// The distance from the axis within which 99 % of the mass lies that has not fallen below the base [m].
double find_foot(const State& state, const Vec3& base, const Vec3& up)
{
    std::vector<std::pair<double, double>> mass_at; // distance, mass
    double mass = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const Vec3 x = state.position[i] - base;
        const double height = x.dot(up);
        if (height + state.radius[i] <= 0.0) continue;
        mass_at.emplace_back((x - height * up).norm(), state.mass(i));
        mass += state.mass(i);
    }
    std::sort(mass_at.begin(), mass_at.end());
    double within = 0.0;
    for (const auto& [distance, m] : mass_at)
        if ((within += m) >= 0.99 * mass) return distance;
    return 0.0;
}

/// Mean heights of rings half a diameter wide, from the axis on.
std::vector<double> ring_means(const Surface& surface, double ring_width)
{
    std::vector<MeanAndError> rings;
    surface.for_each_cell([&](double across, double along, double height) {
        const auto ring = static_cast<std::size_t>(std::hypot(across, along) / ring_width);
        if (ring >= rings.size()) rings.resize(ring + 1);
        rings[ring].add(height);
    });
    std::vector<double> means;
    for (const MeanAndError& ring : rings) means.push_back(ring.count() > 0 ? ring.mean() : 0.0);
    return means;
}

} // namespace

Repose::Repose(std::string sensor_name, const Vec3& base, double inner_radius, double outer_radius)
    : Sensor(std::move(sensor_name)), base_(base), inner_radius_(inner_radius), outer_radius_(outer_radius)
{
}

void Repose::sample(const Snapshot& now)
{
    const Vec3 up = -now.model.gravity.normalized();
    const double fast = moving_speed(now.model), diameter = now.model.mean_diameter;
    moving_ = moving_share(now.state, fast);
    foot_ = find_foot(now.state, base_, up);
    Surface surface(base_, up, diameter, foot_);
    for (std::size_t i = 0; i < now.state.count(); ++i)
        if (now.state.body(i).velocity.norm() <= fast) surface.add(now.state.position[i], now.state.radius[i]);

    const double ring_width = diameter / rings_per_diameter;
    const std::vector<double> means = ring_means(surface, ring_width);
    apex_ = *std::max_element(means.begin(), means.end());
    double inner = inner_radius_, outer = outer_radius_;
    if (outer == 0.0) {
        // From the last ring above 80 % of the height to the first below 20 %, or to where single grains lie.
        const double thin = std::max(0.2 * apex_, 1.5 * diameter);
        inner = 0.0;
        outer = infinity;
        for (std::size_t ring = 0; ring < means.size(); ++ring) {
            const double radius = (static_cast<double>(ring) + 0.5) * ring_width;
            if (means[ring] > 0.8 * apex_) inner = radius;
            if (means[ring] < thin) outer = std::min(outer, radius);
        }
    }
    outer = std::min(outer, foot_);
    height_ = apex_ / diameter;
    width_ = std::max(0.0, outer - inner) / diameter;

    LineFit flank;
    std::array<LineFit, octants> sides;
    surface.for_each_cell([&](double across, double along, double height) {
        const double out = std::hypot(across, along);
        if (out < inner || out > outer || height <= 0.0) return; // there is nothing but floor, or not even that
        flank.add(out, height);
        const double turn = std::atan2(along, across) / (2.0 * std::numbers::pi) + 0.5;
        sides[std::min(octants - 1, static_cast<std::size_t>(turn * octants))].add(out, height);
    });
    angle_ = flank.fall_angle();
    MeanAndError angles;
    for (const LineFit& side : sides) angles.add(side.fall_angle());
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
        std::snprintf(text, sizeof text, "no heap: its flank is %.2g diameters wide", width_);
    return text;
}

} // namespace talus
