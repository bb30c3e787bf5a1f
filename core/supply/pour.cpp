// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/pour.hpp"

#include "core/world/placed_wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

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
        if (around.grown(state.radius[i]).contains(state.position[i] + shift)) near.push_back(i);
    }
    return near;
}

bool overlaps_sphere(const State& state, const std::vector<std::size_t>& near, const Vec3& x, double radius,
    const Periodicity& periodicity)
{
    return std::any_of(near.begin(), near.end(), [&](std::size_t i) {
        const double least = radius + state.radius[i];
        return periodicity.nearest_image(x - state.position[i]).squaredNorm() < least * least;
    });
}

/// Whether the next sphere is due when so much has come in.
bool is_due_after(const Pour& source, double time, double count, double mass)
{
    const double elapsed = time - source.start;
    // Not "at most": at the start a rate that is infinite, because the other rules, gives not-a-number.
    return elapsed >= 0.0 && !(count > elapsed * source.rate) && !(mass > elapsed * source.mass_rate);
}

/// A free place for the deferred sphere, if one is found.
std::optional<Vec3> find_place(Pour& source, const State& state, const std::vector<std::size_t>& near,
    const std::vector<PlacedWall>& walls, const Periodicity& periodicity)
{
    const double radius = 0.5 * source.pending.diameter;
    for (int k = 0; k < tries; ++k) {
        const auto x = source.region.random_point(source.random, radius);
        if (x && !overlaps_sphere(state, near, *x, radius, periodicity) && !touches_wall(walls, *x, radius)) return x;
    }
    return std::nullopt;
}

} // namespace

bool is_over(const Pour& source)
{
    return source.poured >= source.count || source.poured_mass >= source.mass;
}

bool is_due(const Pour& source, double time)
{
    return !is_over(source) && is_due_after(source, time, static_cast<double>(source.poured), source.poured_mass);
}

bool is_behind(const Pour& source, double time, const Materials& materials)
{
    return !is_over(source) && is_due_after(source, time, static_cast<double>(source.poured) + 1.0,
                                   source.poured_mass + source.mixture.mean_mass(materials));
}

double expected_count(const Pour& source, const Materials& materials)
{
    return std::isfinite(source.mass) ? source.mass / source.mixture.mean_mass(materials)
                                      : static_cast<double>(source.count);
}

std::size_t pour(Pour& source, State& state, const Model& model)
{
    if (!is_due(source, state.time)) return 0;

    auto near = spheres_near(state, source.region, 0.5 * source.mixture.max_diameter(), model.periodicity);
    const auto walls = place_walls(model, state);
    std::size_t entered = 0;
    for (; is_due(source, state.time); ++entered) {
        if (source.pending.diameter == 0.0) source.pending = source.mixture.draw(source.random);
        const auto place = find_place(source, state, near, walls, model.periodicity);
        if (!place) {
            ++source.refused;
            break;
        }
        const auto [diameter, material] = std::exchange(source.pending, Grain{});
        const double density = model.materials.list[static_cast<std::size_t>(material)].density;
        near.push_back(add_sphere(state, *place, 0.5 * diameter, density, material, source.velocity));
        ++source.poured;
        source.poured_mass += density * std::numbers::pi / 6.0 * diameter * diameter * diameter;
    }
    return entered;
}

} // namespace talus
