// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "core/base/region.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double step = automatic_step();

/// Goes a way at a speed, from a time on, and back again.
WallMotion to_and_fro(double from, const Vec3& way, double speed)
{
    const double time = way.norm() / speed;
    return {Course{
        {{from, Vec3::Zero()}, {from + time, way}, {from + 2 * time, Vec3::Zero()}, {from + 3 * time, Vec3(-way)}}}};
}

World rigid_world()
{
    return make_world({0.5, 0.0, 0.0, infinity}, production_settings(Stabilisation::projected), step);
}

/// `count` spheres on top of each other between plates that close by `way` each, and open again.
World pressed_chain(int count, double way, double speed)
{
    World world = rigid_world();
    world.add_wall(Disk{Vec3::Zero(), Vec3::UnitZ(), 0.05, 0.0}, to_and_fro(0.0, Vec3(0, 0, way), speed));
    world.add_wall(Disk{Vec3(0, 0, count * d), Vec3::UnitZ(), 0.05, 0.0}, to_and_fro(0.0, Vec3(0, 0, -way), speed));
    for (int k = 0; k < count; ++k) world.add_sphere(Vec3(0, 0, (k + 0.5) * d));
    return world;
}

/// 300 spheres that fall into a box, and a lid that comes down on them by this way from 14 diameters, and goes up
/// again.
World pressed_box(double way, double speed)
{
    World world = rigid_world();
    world.add_wall(box_panels({Vec3::Zero(), Vec3(6 * d, 6 * d, 30 * d)}, {"z+"}));
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        const Vec3 jitter(uniform(random), uniform(random), 0.0);
        const Vec3 place(0.6 + 1.15 * (i % 5), 0.6 + 1.15 * (i / 5 % 5), 0.6 + 1.05 * (i / 25));
        world.add_sphere(
            d * (place + 0.03 * jitter), Vec3::Zero(), Vec3::Zero(), standard_radius * (0.95 + 0.1 * uniform(random)));
    }
    const Panels lid{{{Vec3(0, 0, 14 * d), Vec3(6 * d, 0, 0), Vec3(0, 6 * d, 0)}}};
    world.add_wall(lid, to_and_fro(0.0, Vec3(0, 0, -way), speed));
    return world;
}

struct Told {
    int presses = 0, others = 0;
    double first = infinity; ///< [s]
    Incident press;          ///< the first
    double fastest = 0.0;    ///< of any sphere in any step [m/s]
    double force = 0.0;      ///< largest of any contact [N]
    double left_over = 0.0;  ///< largest of any contact at the end [N]
};

Told run(World& world, double duration)
{
    Told told;
    while (world.state.time < duration) {
        world.step();
        told.fastest = std::max(told.fastest, world.report.bodies.fastest_speed);
        told.left_over = 0.0;
        for (const auto& contact : world.contact_forces())
            told.left_over = std::max(told.left_over, contact.normal_force);
        told.force = std::max(told.force, told.left_over);
        for (const Incident& incident : world.report.bodies.incidents) {
            if (incident.kind != Incident::Kind::pressed) ++told.others;
            if (incident.kind != Incident::Kind::pressed || told.presses++ > 0) continue;
            told.first = world.state.time;
            told.press = incident;
        }
    }
    return told;
}

} // namespace

TEST_CASE("5 a rigid press closes on a sphere", "[hard][quick]")
{
    // Two plates that close on a sphere ask for what no rigid motion can do. Gauss-Seidel adds to both impulses with
    // every sweep, and because its residual is relative to them, it says after a few steps that all is well. The run
    // has to name the bodies; if it goes on, forces stay finite, and nothing is shot away when the press opens.
    HardCase hard("5 a rigid press closes on a sphere");
    constexpr double speed = 1e-3, way = 0.05 * d;
    for (const int spheres : {1, 10}) {
        World world = pressed_chain(spheres, way * spheres, speed * spheres);
        const Told told = run(world, 2.2 * way / speed);
        const std::string which = spheres == 1 ? ", one sphere" : ", a chain of ten";
        hard.holds("reported once" + which, told.presses == 1 && told.others == 0);
        hard.below("overlap when it is reported" + which + " [d]", told.press.overlap / d, 0.03);
        hard.holds("names both walls" + which, told.press.walls == std::vector<std::int32_t>{0, 1});
        hard.holds("names all spheres" + which, told.press.spheres.size() == static_cast<std::size_t>(spheres));
        // What bears a heavy lid at 2 % of overlap bears a press at 5 %.
        hard.should_be_below(
            "largest force" + which + " [weights]", told.force / (world.mass() * standard_gravity), 2e3);
        hard.below("fastest" + which + " [m/s]", told.fastest, 1.0); // a chain buckles
        hard.below("largest force after it has opened" + which + " [weights of all]",
            told.left_over / (spheres * world.mass() * standard_gravity), 1.01);
    }
}

TEST_CASE("5 a rigid press closes on a bed", "[hard]")
{
    HardCase hard("5 a rigid press closes on a bed");
    constexpr double speed = 0.05, way = 7 * d; // the bed is 9 diameters high
    World world = pressed_box(way, speed);
    const Told told = run(world, 2.2 * way / speed);
    hard.holds("it is reported", told.presses > 0 && told.others == 0);
    hard.tell("groups told", told.presses);
    hard.holds("names the lid", std::ranges::find(told.press.walls, 1) != told.press.walls.end());
    hard.below("largest force [weights of the bed]", told.force / (300 * world.mass() * standard_gravity), 100.0);
    hard.below("fastest [m/s]", told.fastest, 1.0);
}

TEST_CASE("5 two walls overlap with a sphere between them", "[hard][quick]")
{
    // Half-spaces that close until they overlap by 0.4 diameters: for the last part no place is left for the centre.
    HardCase hard("5 two walls overlap with a sphere between them");
    constexpr double speed = 0.02, way = 0.7 * d;
    World world = rigid_world();
    world.add_wall(Plane{Vec3::Zero(), Vec3::UnitZ()}, to_and_fro(0.0, Vec3(0, 0, way), speed));
    world.add_wall(Plane{Vec3(0, 0, d), -Vec3::UnitZ()}, to_and_fro(0.0, Vec3(0, 0, -way), speed));
    world.add_sphere(Vec3(0, 0, 0.5 * d));
    const Told told = run(world, 2.2 * way / speed);
    hard.holds("reported once, with both walls and the sphere",
        told.presses == 1 && told.others == 0 && told.press.walls.size() == 2 && told.press.spheres.size() == 1);
    hard.below("overlap when it is reported [d]", told.press.overlap / d, 0.1);
    hard.below("fastest [speed of the walls]", told.fastest / speed, 2.0);
    hard.below("off the line between them at the end [d]", world.position().head<2>().norm() / d, 1e-6);
}
