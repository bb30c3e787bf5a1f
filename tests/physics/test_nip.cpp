// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
constexpr double roller_speed = 0.3; // m/s, of its surface

/// A roller of radius 10 d whose lower side goes along x, this high above a floor.
World roller_over_floor(double gap, double friction, Stabilisation law)
{
    World world = production_world({.friction = friction}, law);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    const Vec3 axis(0, -5 * d, gap + 10 * d);
    world.add_wall(
        Cylinder{axis, Vec3::UnitY(), 10 * d, 10 * d}, {Turning{{}, axis, Vec3::UnitY(), -roller_speed / (10 * d)}});
    return world;
}

} // namespace

TEST_CASE("what a press has crushed comes out no faster than overlap is undone", "[press][push_out][!mayfail]")
{
    // A lid comes down on a sphere by 0.6 d, 0.3 d into each of its sides, and is taken away. Were its contacts
    // elastic, it would jump up with 0.4 of this in a step, 4.7 m/s. A contact that has yielded ends with u_n ≤ p, and
    // shallower than 1 % d, where it is elastic again, nothing has pressed it: its overlap is undone with p.
    const auto law = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World world = production_world({.friction = 0.5}, law);
    constexpr double speed = 0.1, way = 0.6 * d;
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_wall(Disk{Vec3(0, 0, d), Vec3::UnitZ(), 0.05, 0.0}, {Translation{{}, Vec3(0, 0, -speed)}});
    world.model.walls.back().remove_at = way / speed;
    world.add_sphere(Vec3(0, 0, 0.5 * d));
    int presses = 0, others = 0;
    double released = 0.0;
    while (world.state.time < way / speed + 0.5) {
        const bool free = world.state.time > way / speed + world.model.time_step;
        world.step();
        for (const Incident& incident : world.report.bodies.incidents)
            ++(incident.kind == Incident::Kind::pressed ? presses : others);
        if (free) released = std::max(released, world.report.bodies.fastest_speed);
    }
    CHECK(presses == 1);
    CHECK(others == 0);
    CHECK(released <= 1.2 * automatic_push_out_speed());
    CHECK(std::abs(world.position().z() - 0.5 * d) < 1e-3 * d);
}

TEST_CASE("a roller draws grains through a gap a little narrower than they are", "[press]")
{
    // Each overlaps by 2 % d on both sides and rolls between the roller and the floor at half the speed of the roller's
    // surface. The angle at which it is gripped, acos(1 − 0.04/10.5) = 5 degrees, is far within friction.
    const auto law = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World world = roller_over_floor(0.96 * d, 0.5, law);
    for (int k = 0; k < 5; ++k) world.add_sphere(Vec3(-(1.5 + 1.05 * k) * d, 0, 0.5 * d), Vec3(0.15, 0, 0));
    double fastest = 0.0;
    while (world.position(4).x() < 3 * d) {
        world.step();
        REQUIRE(world.state.time < 2.0);
        fastest = std::max(fastest, world.report.bodies.fastest_speed);
    }
    CHECK(fastest < roller_speed);
}

TEST_CASE("a roller that touches the floor crushes what it grips, and shoots nothing away", "[press][!mayfail]")
{
    // With friction 0.8 it draws in what it touches, with 0.2 it pushes it on. What yields parts with p at most from
    // the roller's surface.
    const auto law = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const double friction = GENERATE(0.2, 0.8);
    World world = roller_over_floor(0.0, friction, law);
    for (int k = 0; k < 5; ++k)
        for (int j = -1; j <= 1; ++j)
            world.add_sphere(Vec3(-(5 + 1.05 * k) * d, 1.05 * d * j, 0.5 * d), Vec3(roller_speed, 0, 0));
    double fastest = 0.0;
    while (world.state.time < 1.0) {
        world.step();
        fastest = std::max(fastest, world.report.bodies.fastest_speed);
    }
    CHECK(fastest <= roller_speed + automatic_push_out_speed());
}
