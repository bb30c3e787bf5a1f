// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/step/press.hpp"
#include "tests/support/world.hpp"

#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double step = automatic_step();

/// Spheres at random places in a closed cube, or in the lower part of a higher box, whatever they overlap.
World random_overlaps(int count, double edge, double height)
{
    World world = make_world({0.5, 0.0, 0.0, infinity}, production_settings(Stabilisation::projected), step);
    world.add_wall(box_panels({Vec3::Zero(), Vec3(edge, edge, height)}, {}));
    Random random(11);
    for (int i = 0; i < count; ++i)
        world.add_sphere(
            Vec3::Constant(0.5 * d) + (edge - d) * Vec3(uniform(random), uniform(random), uniform(random)));
    return world;
}

int incidents_in(World& world, int steps)
{
    int incidents = 0;
    for (int k = 0; k < steps; ++k) {
        world.step();
        incidents += static_cast<int>(world.report.incidents.size());
    }
    return incidents;
}

} // namespace

TEST_CASE(
    "a contact is beyond solution when it has been pressed for its steps on end, and comes to be so once", "[press]")
{
    std::uint8_t touched = 0;
    for (int k = 1; k <= 300; ++k) {
        touched = count_pressed(touched);
        CHECK(is_beyond_solution(touched) == (k >= pressed_steps));
        CHECK(came_beyond_solution(touched) == (k == pressed_steps));
    }
}

TEST_CASE("what is beyond solution yields until it has not been pressed for as many steps, and is told once", "[press]")
{
    std::uint8_t touched = 0;
    for (int k = 1; k <= pressed_steps; ++k) touched = count_pressed(touched);
    REQUIRE(came_beyond_solution(touched));
    for (int k = 1; k < pressed_steps; ++k) {
        touched = count_unpressed(touched);
        CHECK(is_beyond_solution(touched));
        CHECK_FALSE(came_beyond_solution(touched));
    }
    SECTION("one step more, and it is as any other")
    {
        touched = count_unpressed(touched);
        CHECK(touched == 1);
        CHECK(count_unpressed(touched) == 1);
    }
    SECTION("pressed again, it yields for as long again")
    {
        touched = count_pressed(touched);
        CHECK_FALSE(came_beyond_solution(touched));
        for (int k = 1; k < pressed_steps; ++k) touched = count_unpressed(touched);
        CHECK(is_beyond_solution(touched));
        CHECK(count_unpressed(touched) == 1);
    }
}

TEST_CASE("overlaps at the start, a shaken bed and a heavy plate are no presses", "[press]")
{
    SECTION("random places, a solid fraction of 0.5, with and without gravity")
    {
        World world = random_overlaps(500, 8.06 * d, 8.06 * d);
        if (GENERATE(true, false)) world.model.gravity = Vec3::Zero();
        CHECK(incidents_in(world, 3000) == 0);
    }
    SECTION("a bed shaken at four times gravity, between floor and lid")
    {
        World world = random_overlaps(200, 7 * d, 7 * d);
        world.model.walls[0].motion = {Shaking{{}, Vec3(0.001, 0, 0.002), 22.0}};
        world.model.physics.moving_walls = true;
        CHECK(incidents_in(world, 6000) == 0);
    }
    SECTION("a plate a thousand times as heavy as a sphere, dropped on a bed")
    {
        World world = random_overlaps(200, 7 * d, 9 * d);
        const double mass = 1000 * world.mass();
        world.add_piston(Disk{Vec3(3.5 * d, 3.5 * d, 7.5 * d), Vec3::UnitZ(), 3.4 * d, 0.0}, mass, -Vec3::UnitZ());
        world.model.pistons[0].inertia = block_inertia(mass, Vec3(7 * d, 7 * d, d));
        world.model.pistons[0].released_at = 0.5;
        CHECK(incidents_in(world, 6000) == 0);
    }
}
