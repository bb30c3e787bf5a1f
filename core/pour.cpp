// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pour.hpp"

#include "core/placed_wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr int tries = 50; ///< places tried for a sphere in one step before it has to wait

/// Spheres that a newcomer in the region could touch.
std::vector<std::size_t> spheres_near(
    const State& state, const Region& region, double radius, const Periodicity& periodicity)
{
    const Box around = region.bounds().grown(radius);
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const Vec3 shift = periodicity.shift_towards(state.position[i], around.center());
        if (around.grown(state.radius(i)).contains(state.position[i] + shift)) near.push_back(i);
    }
    return near;
}

bool overlaps_sphere(const State& state, const std::vector<std::size_t>& near, const Vec3& x, double radius,
    const Periodicity& periodicity)
{
    return std::any_of(near.begin(), near.end(), [&](std::size_t i) {
        const double least = radius + state.radius(i);
        return periodicity.nearest_image(x - state.position[i]).squaredNorm() < least * least;
    });
}

} // namespace

double SizeDistribution::mean_volume() const
{
    // The mean of d³ over a uniform distribution: (max⁴ − min⁴) / (4 (max − min)), written without the difference.
    return std::numbers::pi / 24.0 * (max + min) * (max * max + min * min);
}

std::int64_t due_count(const Pour& source, double time)
{
    if (time < source.start) return 0;
    // In floating point until it is known to be small: a rate of 1e99 means "at once".
    return static_cast<std::int64_t>(
        std::min(static_cast<double>(source.count), 1.0 + std::floor((time - source.start) * source.rate)));
}

std::size_t pour(Pour& source, State& state, const Model& model)
{
    const auto due = due_count(source, state.time);
    if (source.poured >= due) return 0;

    auto near = spheres_near(state, source.region, 0.5 * source.diameter.max, model.periodicity);
    const auto walls = place_walls(model.walls, model.periodicity, state.time);
    std::size_t entered = 0;
    while (source.poured < due) {
        if (source.pending_diameter == 0.0) source.pending_diameter = source.diameter.draw(source.random);
        const double radius = 0.5 * source.pending_diameter;
        bool placed = false;
        for (int k = 0; k < tries && !placed; ++k) {
            const Vec3 x = source.region.random_point(source.random, radius);
            if (overlaps_sphere(state, near, x, radius, model.periodicity) || touches_wall(walls, x, radius)) continue;
            const double density = model.materials.list[static_cast<std::size_t>(source.material)].density;
            near.push_back(add_sphere(state, x, radius, density, source.material, source.velocity));
            placed = true;
        }
        if (!placed) {
            ++source.refused;
            break;
        }
        source.pending_diameter = 0.0;
        ++source.poured;
        ++entered;
    }
    return entered;
}

} // namespace talus
