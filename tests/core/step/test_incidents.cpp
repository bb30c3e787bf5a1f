// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/step/incidents.hpp"
#include "tests/support/world.hpp"

#include <array>
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
        incidents += static_cast<int>(world.report.bodies.incidents.size());
    }
    return incidents;
}

} // namespace

TEST_CASE("a contact that yields is jammed once it comes deeper and deeper, until it yields no more", "[press]")
{
    TouchRecord touch;
    touch.note(TouchRecord::impact);
    for (int k = 0; k < 300; ++k) { // it yields, and bears what there is
        touch.note_yield(k % 2 == 0, false);
        CHECK_FALSE(touch.is_jammed());
    }
    touch.note_yield(true, false);
    if (GENERATE(true, false)) {
        touch.note_yield(true, true); // twice on end, and deep
    } else {
        for (int k = 1; k < 60; ++k) {
            CHECK_FALSE(touch.is_jammed());
            touch.note_yield(true, false);
        }
    }
    CHECK(touch.is_newly_jammed());
    for (int k = 0; k < 300; ++k) { // as long as it is deep, whatever it bears: it is reported once
        touch.note_yield(k % 3 == 0, k % 2 == 0);
        CHECK(touch.is_jammed());
        CHECK_FALSE(touch.is_newly_jammed());
    }
    CHECK(touch.last() == TouchRecord::impact); // which is another matter
    touch.note_hold();
    CHECK_FALSE(touch.is_jammed());
    touch.note_yield(true, true);
    CHECK_FALSE(touch.is_jammed());
    touch.note_yield(true, true); // then it can come to be so anew
    CHECK(touch.is_newly_jammed());
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

TEST_CASE("a wall that appears inside spheres is reported once, with those that it cuts", "[walls][incidents]")
{
    // Six spheres in a row along z, without gravity; a plate appears 0.3 d above the centre of the third, or between
    // two.
    const auto [height, cut] = GENERATE(table<double, std::vector<std::int64_t>>({{2.8 * d, {2}}, {3.1 * d, {}}}));
    World world = make_world({}, production_settings(Stabilisation::matched), step);
    world.model.gravity.setZero();
    for (int k = 0; k < 6; ++k) world.add_sphere(Vec3(0, 0, (0.5 + 1.04 * k) * d));
    world.add_wall(Disk{Vec3(0, 0, height), Vec3::UnitZ(), 0.1});
    world.model.walls.back().appear_at = 10.0 * step;
    std::vector<Incident> told;
    for (int k = 0; k < 50; ++k) {
        world.step();
        for (const Incident& incident : world.report.bodies.incidents) told.push_back(incident);
    }
    REQUIRE(told.size() == (cut.empty() ? 0 : 1));
    if (cut.empty()) return;
    CHECK(told[0].kind == Incident::Kind::appeared_inside);
    CHECK(told[0].spheres == cut);
    CHECK(told[0].id == 2);
    CHECK(told[0].walls == std::vector<std::int32_t>{0});
    CHECK(told[0].overlap == Approx(0.5 * d - std::abs(height - (0.5 + 1.04 * 2) * d)));
    CHECK(world.position(2).z() < (0.5 + 1.04 * 2) * d); // pushed out downwards
}
