// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/findings/quietness.hpp"
#include "tests/support/world.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

TEST_CASE("two rattlers in a hundred do not count as restlessness, a third does", "[quietness]")
{
    World world = make_world({}, rigid_settings(), 1e-3);
    for (int k = 0; k < 100; ++k) world.add_sphere(Vec3(k, 0, 0), k < 2 ? Vec3(1, 0, 0) : Vec3(0.001, 0, 0));
    const double m = world.mass();
    CHECK(energy_without_rattlers(world.state) == within(1e-12, 0.5 * m * 1e-6));
    world.state.body(50).velocity.x() = 0.1;
    CHECK(energy_without_rattlers(world.state) == within(1e-12, 0.5 * m * (97 * 1e-6 + 1e-2) / 98));
    CHECK(energy_without_rattlers(State{}) == 0.0);
}

TEST_CASE("the packing height of a tower is its height, whichever way is up", "[quietness]")
{
    const Vec3 up = GENERATE(Vec3(0, 0, 1), Vec3(-1, 0, 0));
    World world = make_world({}, rigid_settings(), 1e-3);
    for (int k = 0; k < 7; ++k) world.add_sphere((3.0 + (2 * k + 1) * standard_radius) * up);
    CHECK(packing_height(world.state, up) == within(1e-12, 14 * standard_radius));
    CHECK(packing_height(State{}, up) == 0.0);
}

TEST_CASE("the median displacement follows spheres by id, and leaves out those that came or went", "[quietness]")
{
    World world = make_world({}, rigid_settings(), 1e-3);
    for (int k = 0; k < 5; ++k) world.add_sphere(Vec3(k, 0, 0));
    const Displacements displacements(world.state);
    for (std::size_t i = 0; i < 5; ++i) world.state.position[i].y() = 0.1 * static_cast<double>(i);
    CHECK(displacements.median(world.state) == Approx(0.2));
    renumber_spheres(world.state, {4, 3, 2, 1, 0}, 5);
    CHECK(displacements.median(world.state) == Approx(0.2));
    renumber_spheres(world.state, {-1, -1, 0, 1, 2}, 3); // ids 2, 1, 0 are left
    CHECK(displacements.median(world.state) == Approx(0.1));
    world.add_sphere(Vec3(9, 9, 9));
    CHECK(displacements.median(world.state) == Approx(0.1));
}
