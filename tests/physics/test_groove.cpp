// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double time_step = 2.5e-4;

/// A sphere that touches both planes of a groove with its edge along y; the planes rise at this angle from the
/// horizontal.
World sphere_in_groove(double rise, double friction, const SolverSettings& solver)
{
    ContactLaw law;
    law.friction = friction;
    World world = make_world(law, solver, time_step);
    world.add_plane(Vec3::Zero(), Vec3(std::sin(rise), 0, std::cos(rise)));
    world.add_plane(Vec3::Zero(), Vec3(-std::sin(rise), 0, std::cos(rise)));
    world.add_sphere(standard_radius / std::cos(rise) * Vec3::UnitZ());
    return world;
}

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180.0;
}

} // namespace

TEST_CASE("the walls of a frictionless V groove carry m g / (2 cos α) each", "[statics]")
{
    // A wedge of half-angle ψ is the groove of α = 90° − ψ: N = P / (2 sin ψ) under the weight P. Two coupled contacts,
    // solved to 1e-13; `matched` has had 2000 steps to sink in.
    const double rise = radians(GENERATE(30.0, 45.0, 60.0, 80.0));
    World world = sphere_in_groove(rise, 0.0, GENERATE(rigid_settings(), matched_settings()));
    world.step(2000);
    const double weight = world.mass() * standard_gravity;
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 2);
    for (const auto& contact : forces) CHECK(contact.normal_force == within(1e-9, weight / (2.0 * std::cos(rise))));
    CHECK(world.velocity().norm() < 1e-9 * standard_gravity * time_step);
}

TEST_CASE("in a rough V groove the contact forces add up to the weight and stay in their cones", "[statics][friction]")
{
    // How the load is shared between N and T is not determined (self-stress): only sums and cones can be asked for.
    World world = sphere_in_groove(radians(45.0), 0.6, GENERATE(rigid_settings(), matched_settings()));
    world.step(2000);
    const double weight = world.mass() * standard_gravity;
    Vec3 sum = Vec3::Zero();
    for (const auto& contact : world.contact_forces()) {
        sum += contact.normal_force * contact.normal + contact.tangent_force;
        CHECK(contact.tangent_force.norm() <= contact.friction * contact.normal_force + 1e-12 * weight);
    }
    CHECK((sum - weight * Vec3::UnitZ()).norm() < 1e-9 * weight);
    CHECK(world.velocity().norm() < 1e-9 * standard_gravity * time_step);
}

TEST_CASE("a sphere wedged in stays when the load goes if μ > tan ψ, and is expelled by its own elasticity below",
    "[statics][friction][compliance]")
{
    // The load presses the sphere in until 2 N (sin ψ + μ cos ψ) = P or a little beyond, where friction holds it.
    // Without the load the outward push 2 N sin ψ of the stored overlap meets friction 2 T cos ψ: it holds if and only
    // if tan ψ ≤ μ.
    const double half_angle = radians(15.0);
    const double share = GENERATE(1.1, 0.9);
    const double friction = share * std::tan(half_angle);
    World world = sphere_in_groove(0.5 * std::numbers::pi - half_angle, friction, matched_settings());
    world.step(2000);
    REQUIRE(world.contact_forces().size() == 2);
    const double pressed = world.contact_forces()[0].normal_force;
    const double weight = world.mass() * standard_gravity;
    CHECK(pressed > (1 - 1e-9) * 0.5 * weight / (std::sin(half_angle) + friction * std::cos(half_angle)));

    world.model.gravity = Vec3::Zero();
    const Vec3 position = world.position();
    world.step();
    const double stored = world.report.contacts.stored_energy;
    world.step(999);
    CHECK(kinetic_energy(world.state) <= stored);
    if (share > 1) {
        CHECK((world.position() - position).norm() < 1e-12 * standard_radius);
        for (const auto& contact : world.contact_forces()) CHECK(contact.normal_force == within(1e-8, pressed));
    } else {
        CHECK(world.velocity().z() > 0);
        for (const auto& contact : world.contact_forces()) CHECK(contact.gap > 0);
    }
}

TEST_CASE("a rigid sphere in a wedge keeps still when the load goes", "[statics][friction]")
{
    // Nothing is stored in a rigid contact: locked forces may stay or go (both solve the law), but nothing moves.
    const double half_angle = radians(15.0);
    const double share = GENERATE(1.1, 0.9);
    World world = sphere_in_groove(0.5 * std::numbers::pi - half_angle, share * std::tan(half_angle), rigid_settings());
    world.step(100);
    const Vec3 position = world.position();
    world.model.gravity = Vec3::Zero();
    world.step(1000);
    CHECK((world.position() - position).norm() < 1e-9 * standard_radius);
    CHECK(world.velocity().norm() < 1e-12);
}

} // namespace talus::test
