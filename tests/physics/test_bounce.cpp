// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

ContactLaw restitution(double e)
{
    ContactLaw law;
    law.restitution = e;
    return law;
}

/// A sphere dropped from rest, its lowest point `height` above the floor.
World dropped_sphere(double height, double e, const SolverSettings& solver, double h)
{
    World world = sphere_on_plane(restitution(e), solver, h);
    world.state.position[0] += height * Vec3::UnitZ();
    return world;
}

bool moves_up(const World& world)
{
    return world.velocity().z() > 0;
}
bool moves_down(const World& world)
{
    return world.velocity().z() < 0;
}

} // namespace

TEST_CASE("a sphere thrown at a wall comes back with e times its speed", "[restitution]")
{
    // Chung & Ooi (2011) test 3: r = 2.5 mm, 3.9 m/s, no gravity. Newton's law takes u_n⁻ from the velocity before the
    // step, and one frictionless contact is solved in one sweep: nothing but round-off is left.
    const double e = GENERATE(0.2, 0.4, 0.6, 0.8, 1.0);
    const double speed = 3.9;
    World world = sphere_on_plane(
        restitution(e), GENERATE(rigid_settings(), matched_settings()), 1e-5, Vec3::Zero(), Vec3::Zero(), 0.0025);
    world.model.gravity = Vec3::Zero();
    world.state.position[0].z() += 1e-3;
    world.state.body(0).velocity = Vec3(0, 0, -speed);
    advance_until(world, moves_up, 100);
    CHECK(world.velocity().z() == within(1e-14, e * speed));
    world.step(100);
    CHECK(world.velocity().z() == within(1e-14, e * speed));
}

TEST_CASE("a rigid impact without restitution is perfectly plastic", "[restitution]")
{
    // An open gap is first closed (u_n = −g/h), then u_n ≥ 0 holds: the sphere stops on the surface and stays there.
    World world = dropped_sphere(1e-3, 0.0, rigid_settings(), 1e-4);
    world.model.gravity = Vec3::Zero();
    world.state.body(0).velocity = Vec3(0, 0, -1);
    world.step(100);
    CHECK(world.velocity().norm() < 1e-15);
    CHECK(world.position().z() == within(1e-14, standard_radius));
}

TEST_CASE("each peak of a bouncing sphere is e² times as high as the one before", "[restitution]")
{
    // Dropped from H the k-th peak is e^{2k} H. The turn happens up to V h above the floor and V is wrong by up to g h,
    // which moves the first peak by at most 2 V h (V² = 2 g H) and the later ones by less.
    const double height = 1.0;
    const double e = 0.5;
    const double h = GENERATE(1e-3, 1e-4);
    World world = dropped_sphere(height, e, GENERATE(rigid_settings(), matched_settings()), h);
    const double error = 2.0 * std::sqrt(2.0 * standard_gravity * height) * h;
    double peak = height;
    for (int k = 1; k <= 3; ++k) {
        advance_until(world, moves_up, 20000);
        advance_until(world, moves_down, 20000);
        peak *= e * e;
        CHECK(world.position().z() - standard_radius == Approx(peak).margin(error));
    }
}

TEST_CASE("a sphere rebounds under gravity with e times the speed it had before the step", "[restitution]")
{
    const double e = GENERATE(0.3, 0.7, 0.95);
    World world = dropped_sphere(0.2, e, GENERATE(rigid_settings(), matched_settings()), 1e-3);
    double before = 0.0;
    while (!moves_up(world)) {
        before = world.velocity().z();
        world.step();
        REQUIRE(world.state.steps < 1000);
    }
    CHECK(world.velocity().z() == within(1e-14, -e * before)); // one contact, one sweep: round-off
}

TEST_CASE("a bouncing sphere comes to rest after finitely many bounces and lies still", "[restitution][statics]")
{
    // Speeds fall as eᵏ V until they pass 3 g h, below which nothing rebounds: k bounces with eᵏ V ≈ 3 g h, one more or
    // less for the instant of impact. The law's infinite series ends at t = √(2H/g) (1 + e)/(1 − e) = 1.3546 s.
    const double height = 1.0;
    const double e = 0.5;
    const double h = 1e-3;
    const double speed = std::sqrt(2.0 * standard_gravity * height);
    const double expected_bounces = std::log(3.0 * standard_gravity * h / speed) / std::log(e);
    const auto stabilisation = GENERATE(Stabilisation::projected, Stabilisation::matched);
    World world = dropped_sphere(height, e, production_settings(stabilisation), h);

    int bounces = 0;
    double path = 0.0;
    bool was_falling = false;
    while (world.state.time < 1.5) {
        const double z = world.position().z();
        world.step();
        path += std::abs(world.position().z() - z);
        // What `matched` does while it settles into its overlap is slower than g h and no bounce.
        bounces += was_falling && world.velocity().z() > standard_gravity * h;
        was_falling = moves_down(world);
    }
    CHECK(bounces == Approx(expected_bounces).margin(1.0));
    CHECK(path == Approx(height * (1 + e * e) / (1 - e * e)).margin(2.0 * speed * h));

    const double z = world.position().z();
    world.step(1000);
    CHECK(world.velocity().norm() < 1e-12); // no jitter: 1e-10 of g h
    CHECK(world.position().z() == within(1e-12, z));
}

TEST_CASE("a gap that another's impact closes rebounds in the next step, with all of its approach", "[restitution]")
{
    // The lower sphere would not reach the floor in this step, were it not hit from above: its contact with the floor
    // is not in the problem. In the next step it overlaps, and the whole of its approach turns round with e = 1.
    const double gap = GENERATE(3.1e-4, 3.7e-4, 4.3e-4);
    const double h = 1e-3;
    World world = make_world({.restitution = 1.0}, GENERATE(rigid_settings(), matched_settings()), h);
    world.model.gravity.setZero();
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0, 0, standard_radius + gap), Vec3(0, 0, -0.3));
    world.add_sphere(Vec3(0, 0, 3 * standard_radius + gap + 1e-4), Vec3(0, 0, -2.0));
    world.step();
    CHECK(world.velocity(0).z() == within(1e-12, -2.0));
    world.step();
    CHECK(world.velocity(0).z() == within(1e-12, 2.0));
}

TEST_CASE("what is struck back within an impact rebounds once more", "[restitution]")
{
    // An impact leaves no load: the contact is still closed, and the next blow finds it as the first one did.
    World world = make_world({.restitution = 1.0}, production_settings(Stabilisation::projected), 1e-4);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0, 0, 0.9 * standard_radius), Vec3(0, 0, -1));
    for (int blow = 0; blow < 3; ++blow) {
        world.state.body(0).velocity = Vec3(0, 0, -1);
        world.state.position[0].z() = 0.9 * standard_radius;
        world.step();
        CHECK(world.velocity(0).z() == Approx(1.0).epsilon(1e-9));
    }
}

} // namespace talus::test
