// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contacts.hpp"
#include "tests/support/world.hpp"

#include "core/law/hertz.hpp"

#include <cmath>
#include <numbers>
#include <vector>

// Hertz (1882): two elastic spheres that overlap by κ press with 4/3 E* √R* κ^(3/2), and hold 8/15 E* √R* κ^(5/2).

namespace talus::test
{
namespace
{

constexpr double r = standard_radius, g = standard_gravity;
const double mass = standard_density * 4.0 / 3.0 * std::numbers::pi * r * r * r;

double overlap_under(double force, double modulus, double reduced_radius)
{
    return std::pow(force / (4.0 / 3.0 * modulus * std::sqrt(reduced_radius)), 2.0 / 3.0);
}

World elastic_world(double modulus, double step)
{
    World world = make_world({.modulus = modulus}, matched_settings(), step);
    world.model.physics.elasticity = true;
    world.model.solver.push_out_speed = automatic_push_out_speed();
    return world;
}

/// A sphere that touches a floor.
World on_floor(double modulus, double step)
{
    World world = elastic_world(modulus, step);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(r * Vec3::UnitZ());
    return world;
}

/// The stiffness that sweeps can carry at a floor [N/m].
double carried_at_floor(double step)
{
    return carried_stiffness<double>(1.0 / mass, {.h = step, .min_sweeps = 2.0});
}

/// E* above which a sphere on a floor is softer than Hertz says, since sweeps carry no more.
double stiffest_modulus(double step)
{
    const double carried = carried_at_floor(step);
    return 0.6 * carried * std::sqrt(0.8 * carried / (mass * g * r));
}

} // namespace

TEST_CASE("a sphere at rest on an elastic floor overlaps as Hertz says, whatever the step", "[elasticity]")
{
    const double step = GENERATE(1.0, 0.5) * automatic_step(), softness = GENERATE(1e-5, 0.01, 0.1, 0.5, 0.99);
    const double modulus = softness * stiffest_modulus(step), overlap = overlap_under(mass * g, modulus, r);
    World world = on_floor(modulus, step);
    world.step(20000);
    CHECK(r - world.position().z() == within(1e-6, overlap));
    if (overlap < yield_overlap * r)
        CHECK(world.report.contacts.stored_energy == within(1e-5, 0.4 * mass * g * overlap));
}

TEST_CASE("no elastic contact is stiffer than its sweeps can carry", "[elasticity]")
{
    const double step = automatic_step(), carried = carried_at_floor(step), modulus = 3.0 * stiffest_modulus(step);
    const HertzLaw<double> law(modulus, r, carried);
    World world = on_floor(modulus, step);
    world.step(5000);
    CHECK(r - world.position().z() == within(1e-6, mass * g / carried + 0.2 * law.knee));
    World rigid = on_floor(infinity, step);
    rigid.step(5000);
    CHECK(r - rigid.position().z() == within(1e-6, mass * g / carried));
}

TEST_CASE("spheres of any sizes in a column bear what is above them, each as Hertz says", "[elasticity]")
{
    const double step = automatic_step(), modulus = 0.05 * stiffest_modulus(step);
    const std::vector<double> radii = {r, 0.6 * r, 1.2 * r, r};
    World world = elastic_world(modulus, step);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    double top = 0.0;
    for (const double radius : radii) {
        world.add_sphere((top + radius) * Vec3::UnitZ(), Vec3::Zero(), Vec3::Zero(), radius);
        top += 2.0 * radius;
    }
    world.step(60000);
    double load = 0.0, stored = 0.0;
    for (std::size_t k = radii.size(); k-- > 0;) {
        load += world.mass(static_cast<std::int64_t>(k)) * g;
        const double below = k > 0 ? radii[k - 1] : infinity, reduced = 1.0 / (1.0 / radii[k] + 1.0 / below);
        const double overlap = overlap_under(load, modulus, reduced);
        const double rest = k > 0 ? world.position(static_cast<std::int64_t>(k - 1)).z() + below : 0.0;
        CAPTURE(k);
        CHECK(rest + radii[k] - world.position(static_cast<std::int64_t>(k)).z() == within(1e-6, overlap));
        stored += 0.4 * load * overlap;
    }
    CHECK(world.report.contacts.stored_energy == within(1e-5, stored));
}

TEST_CASE("a sphere on an elastic floor swings with the frequency of Hertz's tangent", "[elasticity]")
{
    // ω² = 3/2 k/m, k the secant stiffness under its weight: the tangent is half as stiff again.
    const double step = 0.05 * automatic_step(), modulus = 2e-6 * stiffest_modulus(step);
    const double omega = std::sqrt(1.5 * secant_stiffness(modulus, r, mass * g) / mass);
    REQUIRE(omega * step < 0.05);
    World world = on_floor(modulus, step);
    world.step(100000);
    world.state.bodies[0].velocity.z() = 0.01 * g / omega;
    const auto half_swing = [&](double sign) {
        return advance_until(
            world, [&](const World& w) { return sign * w.velocity().z() < 0.0; }, 100000);
    };
    half_swing(1.0);
    const int steps = half_swing(-1.0) + half_swing(1.0);
    CHECK(steps * step == within(0.02, 2.0 * std::numbers::pi / omega));
}

TEST_CASE("what a loaded plate presses flat comes back when the load goes", "[elasticity][piston]")
{
    const double step = automatic_step(), modulus = 0.02 * stiffest_modulus(step), load = 20.0 * mass * g;
    World world = on_floor(modulus, step);
    const std::size_t k = world.add_piston(Disk{2.0 * r * Vec3::UnitZ(), Vec3::UnitZ(), r, 0.0}, mass, -Vec3::UnitZ(),
        {{0.0, 0.0}, {2.0, 0.0}, {3.0, load}, {5.0, load}, {6.0, 0.0}});
    for (const auto& [time, pressed] : {std::pair{2.0, 0.0}, {5.0, load}, {8.0, 0.0}}) {
        while (world.state.time < time) world.step();
        const double way =
            overlap_under(mass * g + pressed, modulus, r) + overlap_under(2.0 * mass * g + pressed, modulus, r);
        CAPTURE(time);
        CHECK(travel(world.model.pistons[k], world.state.pistons[k]) == within(1e-5, way));
    }
}

} // namespace talus::test
