// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{

TEST_CASE("a heavy ball that squeezes a light one against the floor comes back, and never faster than it came",
    "[stabilisation][compression]")
{
    // A contact is a spring that is damped for the lighter sphere, so the heavy one gets back a part of its speed that
    // no law tells, whatever e (METHOD, limits); but no more than all of it.
    const double ratio = GENERATE(100.0, 3000.0), e = GENERATE(0.0, 0.4, 0.9);
    const double move = GENERATE(0.01, 0.1, 0.3);     // diameters of the light one in a step
    const double start = GENERATE(0.001, 0.027, 0.5); // gap between them, in its diameters
    CAPTURE(ratio, e, move, start);
    const double d = 2 * standard_radius, speed = 1.0;
    World world = make_world({0.0, e, 0.0, infinity}, production_settings(Stabilisation::matched), move * d / speed);
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = automatic_push_out_speed();
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0, 0, standard_radius));
    const double radius = standard_radius * std::cbrt(ratio);
    world.add_sphere(Vec3(0, 0, d + start * d + radius), Vec3(0, 0, -speed), Vec3::Zero(), radius);
    const double energy = kinetic_energy(world.state);
    for (int n = 0; n < 20000 && world.velocity(1).z() < 0.01 * speed; ++n) {
        world.step();
        REQUIRE(kinetic_energy(world.state) <= 1.0001 * energy);
    }
    world.step(200);
    CHECK(world.velocity(1).z() > 0.0);
    CHECK(world.velocity(1).z() <= speed);
    CHECK(world.position(1).z() > radius);
}

} // namespace talus::test
