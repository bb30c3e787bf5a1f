// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double friction = 0.2;
constexpr double time_step = 1e-3;
constexpr int settling = 200; ///< steps in which `matched` sinks into its overlap; `projected` needs none
constexpr int measured = 300; ///< steps

/// A sphere at rest on an incline of this angle. The world is tilted, not the plane: downhill is x.
World sphere_on_incline(double angle, const ContactLaw& law, const SolverSettings& solver)
{
    World world = sphere_on_plane(law, solver, time_step);
    world.model.gravity = standard_gravity * Vec3(std::sin(angle), 0, -std::cos(angle));
    return world;
}

struct Acceleration {
    double linear;  ///< downhill [m/s²]
    double angular; ///< [rad/s²]
};

Acceleration measure_acceleration(World& world)
{
    world.step(settling);
    const double speed = world.velocity().x();
    const double spin = world.angular_velocity().y();
    world.step(measured);
    const double duration = measured * time_step;
    return {(world.velocity().x() - speed) / duration, (world.angular_velocity().y() - spin) / duration};
}

const double critical_angle = std::atan(3.5 * friction); // 34.992° for μ = 0.2
const double half_a_degree = 0.5 * std::numbers::pi / 180.0;

ContactLaw rough()
{
    ContactLaw law;
    law.friction = friction;
    return law;
}

} // namespace

TEST_CASE("a sphere rolls down an incline without slip when tan θ ≤ 7/2 μ", "[friction]")
{
    // Rolling takes T = 2/7 m g sin θ, which friction gives while 2/7 tan θ ≤ μ; then a = 5/7 g sin θ. Both are linear
    // in time and exact in every step: 1e-9 is the change that `matched` may still show after its settling.
    const double angle = GENERATE(critical_angle - half_a_degree, 0.5 * critical_angle);
    World world = sphere_on_incline(angle, rough(), GENERATE(rigid_settings(), matched_settings()));
    const auto acceleration = measure_acceleration(world);
    CHECK(acceleration.linear == within(1e-9, 5.0 / 7.0 * standard_gravity * std::sin(angle)));
    CHECK(slip(world).norm() < 1e-10 * world.velocity().norm());

    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    CHECK(forces[0].tangent_force.norm() / forces[0].normal_force == within(1e-9, 2.0 / 7.0 * std::tan(angle)));
}

TEST_CASE("a sphere slips down an incline when tan θ > 7/2 μ", "[friction]")
{
    // T = μ m g cos θ: a = g (sin θ − μ cos θ), dω/dt = 5/2 μ g cos θ / r.
    const double angle = GENERATE(critical_angle + half_a_degree, 1.2);
    World world = sphere_on_incline(angle, rough(), GENERATE(rigid_settings(), matched_settings()));
    const auto acceleration = measure_acceleration(world);
    CHECK(acceleration.linear == within(1e-9, standard_gravity * (std::sin(angle) - friction * std::cos(angle))));
    CHECK(acceleration.angular == within(1e-9, 2.5 * friction * standard_gravity * std::cos(angle) / standard_radius));
    CHECK(slip(world).x() > 0);
}

TEST_CASE("without friction a sphere slides down an incline with g sin θ", "[friction]")
{
    const double angle = 0.4;
    World world = sphere_on_incline(angle, {}, GENERATE(rigid_settings(), matched_settings()));
    const auto acceleration = measure_acceleration(world);
    CHECK(acceleration.linear == within(1e-12, standard_gravity * std::sin(angle)));
    CHECK(world.angular_velocity() == Vec3::Zero());
}

} // namespace talus::test
