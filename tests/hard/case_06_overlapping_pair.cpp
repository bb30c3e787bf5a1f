// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <cmath>

using namespace talus;
using namespace talus::test;

TEST_CASE("6 two spheres at rest overlap by 30 %", "[hard][quick]")
{
    // Without gravity they must part with the push-out speed p = 0.1 √(d g), symmetrically, and hardly faster: as much
    // becomes compression in a step as they part in it.
    HardCase hard("6 two spheres at rest overlap by 30 %");
    constexpr double d = 2 * standard_radius;
    const double p = automatic_push_out_speed();
    World world = make_world({}, production_settings(Stabilisation::matched), automatic_step());
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = p;
    world.add_sphere(Vec3(0.35 * d, 0, 0));
    world.add_sphere(Vec3(-0.35 * d, 0, 0));
    world.step(2000);
    const Vec3 parting = world.velocity(0) - world.velocity(1);
    hard.between("speed of parting [push-out speed]", parting.norm() / p, 1.0, 1.2);
    hard.below("momentum [m x speed]", world.momentum().norm() / (world.mass() * parting.norm()), 1e-14);
    hard.below("asymmetry [d]", (world.position(0) + world.position(1)).norm() / d, 1e-13);
    hard.holds("they no longer overlap", (world.position(0) - world.position(1)).norm() > d);
}
