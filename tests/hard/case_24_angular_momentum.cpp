// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "core/base/region.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

/// A ball of 200 spheres of two sizes at random places, up to half a diameter deep in each other, that spin and move,
/// far from the origin, without gravity.
World crowd(Stabilisation stabilisation, double restitution)
{
    World world = production_world({.friction = 0.6, .restitution = restitution}, stabilisation);
    world.model.gravity.setZero();
    Random random(24);
    const auto random_vector = [&](double size) {
        const double x = uniform(random) - 0.5, y = uniform(random) - 0.5;
        return Vec3(size * Vec3(x, y, uniform(random) - 0.5));
    };
    while (world.state.count() < 200) {
        const Vec3 place = Vec3(1, -2, 3) + random_vector(0.05);
        const double radius = world.state.count() % 2 ? standard_radius : 0.6 * standard_radius;
        const bool crowded = std::any_of(world.state.position.begin(), world.state.position.end(),
            [&](const Vec3& x) { return (x - place).norm() < standard_radius; });
        if (!crowded) world.add_sphere(place, random_vector(1.0), random_vector(400.0), radius);
    }
    return world;
}

/// Σ m (|x| |v| + 2/5 r |a|), a = r ω: what rounding is measured against.
double angular_scale(const State& state)
{
    double scale = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const Body& m = state.body(i);
        scale += (state.position[i].norm() * m.velocity.norm() + 0.4 * state.radius[i] * m.rim_velocity.norm()) /
                 m.inverse_mass;
    }
    return scale;
}

} // namespace

TEST_CASE("24 angular momentum with large overlap", "[hard][quick]")
{
    // Friction acts on each sphere of a pair with a lever arm; with the radii for arms, which together are longer than
    // the distance of overlapping centres, each contact makes angular momentum of nothing: up to 28 % here in a single
    // collision. Sums over 1000 steps of all contacts, to rounding, unconverged as the sweeps are.
    // `projected` keeps it in its velocities too, but then moves spheres apart: that turns the arms of their
    // velocities. Without restitution none is in flight: impulses act where the step begins. What closes a gap does so
    // along the normal that it will have, a part of a step ahead: that is all that is left, 2e-7 in a thousand steps.
    HardCase hard("24 angular momentum with large overlap");
    World world = crowd(Stabilisation::matched, 0.3);
    const double scale = angular_scale(world.state);
    const Vec3 angular = angular_momentum(world.state), linear = linear_momentum(world.state);
    double own = 0.0, worst = 0.0, worst_linear = 0.0, deepest = 0.0;
    for (const auto& m : world.state.bodies) own += m.velocity.norm() / m.inverse_mass;
    for (int k = 0; k < 1000; ++k) {
        world.step();
        worst = std::max(worst, (angular_momentum(world.state) - angular).norm() / scale);
        worst_linear = std::max(worst_linear, (linear_momentum(world.state) - linear).norm() / own);
        deepest = std::max(deepest, world.report.contacts.worst_overlap / (2 * standard_radius));
    }
    hard.above("deepest overlap [d]", deepest, 0.3);
    hard.below("angular momentum over 1000 steps, error", worst, 1e-6);
    hard.below("momentum over 1000 steps, error", worst_linear, 1e-12);

    World moved = crowd(Stabilisation::projected, 0.0);
    double by_moving = 0.0, by_impulses = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const State before = moved.state;
        moved.step();
        State unmoved = moved.state; // with the impulses of the step, where it began
        for (std::size_t i = 0; i < unmoved.count(); ++i) {
            const auto id = unmoved.id[i];
            const auto old = std::find(before.id.begin(), before.id.end(), id) - before.id.begin();
            unmoved.position[i] = before.position[static_cast<std::size_t>(old)];
        }
        by_impulses = std::max(by_impulses, (angular_momentum(unmoved) - angular_momentum(before)).norm() / scale);
        by_moving = std::max(by_moving, (angular_momentum(moved.state) - angular).norm() / scale);
    }
    hard.below("projected: angular momentum made by impulses in a step, error", by_impulses, 1e-6);
    hard.below("projected: angular momentum over 1000 steps, moving apart included, error", by_moving, 1e-4);
}
