// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contacts.hpp"
#include "tests/support/world.hpp"

#include "core/law/attraction.hpp"

#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double pi = std::numbers::pi;
constexpr double r = standard_radius, d = 2.0 * standard_radius, g = standard_gravity;
constexpr double step = 1e-4;

double mass_of(double radius)
{
    return standard_density * 4.0 / 3.0 * pi * radius * radius * radius;
}

/// A sphere that touches a ceiling from below.
World below_ceiling(double force, const SolverSettings& solver)
{
    World world = make_world({}, solver, step);
    world.attract({.force = force, .range = 0.01 * d});
    world.add_plane(Vec3::Zero(), -Vec3::UnitZ());
    world.add_sphere(-r * Vec3::UnitZ());
    return world;
}

/// Two spheres of these radii at such a gap along x, without gravity. Sphere 0 is on the right.
World pair(const Attraction& law, double right, double left, double gap, const SolverSettings& solver)
{
    World world = make_world({}, solver, step);
    world.model.gravity.setZero();
    world.attract(law);
    world.add_sphere((right + 0.5 * gap) * Vec3::UnitX(), Vec3::Zero(), Vec3::Zero(), right);
    world.add_sphere(-(left + 0.5 * gap) * Vec3::UnitX(), Vec3::Zero(), Vec3::Zero(), left);
    return world;
}

void pull_apart(World& world, double force)
{
    world.state.own_force.assign(2, Vec3::Zero());
    world.state.own_force[world.index_of(0)] = force * Vec3::UnitX();
    world.state.own_force[world.index_of(1)] = -force * Vec3::UnitX();
}

/// The force with which a pair that has touched is drawn together, once its gap is this.
double force_at(const Attraction& law, double right, double left, double gap)
{
    World world = pair(law, right, left, 0.0, rigid_settings());
    world.step();
    const double before = world.position(0).x() - world.position(1).x() - right - left;
    world.state.position[world.index_of(0)].x() += gap - before;
    for (Body& body : world.state.bodies) body.velocity.setZero();
    world.step();
    return -world.velocity(0).x() * mass_of(right) / step;
}

} // namespace

TEST_CASE("a sphere hangs from a ceiling until it is heavier than the attraction", "[attraction]")
{
    const double weight = mass_of(r) * g;
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    World light = below_ceiling(weight * (1.0 + 1e-12), solver), heavy = below_ceiling(weight * (1.0 - 1e-12), solver);
    light.step(1000);
    heavy.step(1000);
    CHECK(light.velocity().norm() <= 1e-16);
    CHECK(heavy.velocity().z() == Approx(-1e-12 * g * 1000 * step).epsilon(1e-3));

    World falls = below_ceiling(0.5 * weight, solver);
    falls.step(200); // half its weight for 0.45 mm, and then all of it
    const double out_of_range = std::sqrt(2.0 * 0.01 * d / (0.5 * g));
    const double fast = 0.5 * g * out_of_range + g * (200 * step - out_of_range);
    CHECK(falls.velocity().z() == Approx(-fast).margin(g * step));
}

TEST_CASE("two spheres hold until they are pulled with the force of their law", "[attraction]")
{
    const double w = 0.05, left = GENERATE(1.0, 0.3) * r, reduced = r * left / (r + left);
    const auto [by_radius, pull_off] =
        GENERATE_COPY(std::pair{2.0 * pi * w, 2.0 * pi * w * reduced}, std::pair{1.5 * pi * w, 1.5 * pi * w * reduced});
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    for (const double share : {1.0 - 1e-12, 1.0 + 1e-12}) {
        World world = pair({.by_radius = by_radius, .range = 0.01 * d}, r, left, 0.0, solver);
        pull_apart(world, share * pull_off);
        world.step(500);
        const double parting = (world.velocity(0) - world.velocity(1)).x();
        const double alone = 1e-12 * pull_off * (1.0 / mass_of(r) + 1.0 / mass_of(left)) * 500 * step;
        if (share < 1.0)
            CHECK(std::abs(parting) <= 1e-3 * alone);
        else
            CHECK(parting == Approx(alone).epsilon(1e-3));
    }
}

TEST_CASE(
    "the force of a liquid bridge falls with the gap until it breaks, and comes back with a touch", "[attraction]")
{
    // Willett et al. (2000): 2πRγ cos θ/(1 + 1.05 s + 2.5 s²), s = g √(R/V), with R = 2 r₁ r₂/(r₁ + r₂); it breaks at
    // (1 + θ/2) V^⅓ (Lian, Thornton & Adams 1993).
    const double tension = 0.072, angle = 0.3, volume = 1e-3 * d * d * d, left = GENERATE(1.0, 0.4) * r;
    const double R = 2.0 * r * left / (r + left), rupture = (1.0 + 0.5 * angle) * std::cbrt(volume);
    const Attraction law{.by_radius = 4.0 * pi * tension * std::cos(angle), .range = rupture, .volume = volume};
    for (const double share : {0.0, 0.01, 0.3, 0.99}) {
        const double gap = share * rupture, s = gap * std::sqrt(R / volume);
        const double force = 2.0 * pi * R * tension * std::cos(angle) / (1.0 + 1.05 * s + 2.5 * s * s);
        if (share > 0.0) CHECK(force_at(law, r, left, gap) == Approx(force).epsilon(1e-9));
    }
    CHECK(force_at(law, r, left, 1.001 * rupture) == 0.0);

    World world = pair(law, r, left, 0.0, rigid_settings());
    world.step();
    world.state.position[world.index_of(0)].x() += 1.1 * rupture; // it breaks
    world.step();
    world.state.position[world.index_of(0)].x() -= 0.9 * rupture; // and is not there, though it is near
    world.step(10);
    CHECK(world.velocity(0).norm() < 1e-12);
    world.state.bodies[world.index_of(0)].velocity = -0.1 * Vec3::UnitX(); // until they touch
    world.step(1000);
    CHECK((world.velocity(0) - world.velocity(1)).norm() < 1e-6);
    CHECK((world.position(0) - world.position(1)).norm() - r - left < 1e-6 * d);
}

TEST_CASE("the energy of an attraction is what its force gives up on the way to its range", "[attraction]")
{
    const double volume = GENERATE(0.0, 1e-3 * d * d * d), range = 0.1 * d;
    const AttractionOfPair law({.force = 1e-3, .by_radius = 0.1, .range = range, .volume = volume}, 0.5 * r, 0.0);
    for (const double from : {-0.02 * d, 0.0, 0.03 * d}) {
        double sum = 0.0;
        constexpr int parts = 200000;
        for (int k = 0; k < parts; ++k) sum += law.force(from + (k + 0.5) / parts * (range - from));
        CHECK(law.energy(from) == Approx(-sum * (range - from) / parts).epsilon(1e-8));
    }
    CHECK(law.energy(range) == 0.0);
}

TEST_CASE("what has not touched is not attracted", "[attraction]")
{
    World world =
        pair({.force = 1.0, .range = 0.01 * d}, r, r, 0.005 * d, GENERATE(rigid_settings(), matched_settings()));
    world.step(100);
    CHECK(world.velocity(0).norm() == 0.0);
}

TEST_CASE("a sphere leaves a floor that attracts it if its energy is more than that of the attraction", "[attraction]")
{
    const double range = 0.1 * d, force = 20.0 * mass_of(r) * g;
    const double escape = std::sqrt(2.0 * force * range / mass_of(r));
    for (const double share : {0.9, 1.1}) {
        World world = make_world({.restitution = 1.0}, rigid_settings(), 1e-6);
        world.model.gravity.setZero();
        world.attract({.force = force, .range = range});
        world.add_plane(Vec3::Zero(), Vec3::UnitZ());
        world.add_sphere(r * Vec3::UnitZ(), share * escape * Vec3::UnitZ());
        world.step(40000);
        if (share > 1.0)
            CHECK(world.velocity().z() == Approx(escape * std::sqrt(share * share - 1.0)).epsilon(0.02));
        else
            CHECK(world.position().z() < r + range);
    }
}

TEST_CASE("attraction presses a sphere on a wall, and friction holds it there", "[attraction]")
{
    const double friction = 0.5, weight = mass_of(r) * g;
    for (const double share : {0.99, 1.01}) {
        World world = make_world({.friction = friction}, GENERATE(rigid_settings(), matched_settings()), step);
        world.model.physics.spin = false;
        world.attract({.force = weight / friction / share, .range = 0.01 * d});
        world.add_plane(Vec3::Zero(), Vec3::UnitX());
        world.add_sphere(r * Vec3::UnitX());
        world.step(1000);
        if (share < 1.0)
            CHECK(world.velocity().norm() < 1e-9 * g);
        else
            CHECK(-world.velocity().z() == Approx((1.0 - 1.0 / share) * g * 1000 * step).epsilon(1e-3));
    }
}

TEST_CASE("a pair that turns round each other keeps its angular momentum", "[attraction]")
{
    World world = pair({.force = 1e-3, .range = 0.1 * d}, r, r, 0.0, GENERATE(rigid_settings(), matched_settings()));
    world.step();
    for (const int id : {0, 1})
        world.state.bodies[world.index_of(id)].velocity = (id == 0 ? 0.1 : -0.1) * Vec3(0.05, 1.0, 0.0);
    const auto momentum = [&] {
        double sum = 0.0;
        for (const int id : {0, 1}) sum += world.position(id).cross(world.velocity(id)).z();
        return sum;
    };
    const double before = momentum();
    double widest = 0.0;
    for (int k = 0; k < 2000; ++k) {
        world.step();
        widest = std::max(widest, (world.position(0) - world.position(1)).norm() - d);
    }
    CHECK(widest > 1e-4 * d);                          // it parts and is drawn back
    CHECK(momentum() == Approx(before).epsilon(2e-3)); // impulses of contacts act where paths meet
}

TEST_CASE("what sticks passes from wall to wall and still does", "[attraction]")
{
    World world = make_world({}, GENERATE(rigid_settings(), matched_settings()), step);
    world.attract({.force = 20.0 * mass_of(r) * g, .range = 0.1 * d});
    world.model.gravity = g * Vec3::UnitZ(); // upwards: it hangs
    world.add_wall(Disk{Vec3(-10 * r, 0, 0), Vec3::UnitZ(), 10 * r, 0.0});
    world.add_wall(Disk{Vec3(10 * r, 0, 0), Vec3::UnitZ(), 10 * r, 0.0});
    world.add_sphere(Vec3(-r, 0, r), Vec3(0.3, 0, 0.1));
    double highest = 0.0;
    while (world.position().x() < r) {
        world.step();
        highest = std::max(highest, world.position().z() - r);
    }
    CHECK(highest > 1e-4 * d);
    CHECK(highest < 0.1 * d);
}

TEST_CASE("a bed that sticks with a thousand times its weight comes to rest", "[attraction]")
{
    const auto law = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World world = make_world({.friction = 0.5}, production_settings(law), 2e-5);
    world.model.solver.push_out_speed = automatic_push_out_speed(d);
    world.attract({.by_weight = 1000.0, .range = 0.01 * d});
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    const auto shaken = [](int k) { return Vec3(0.05 * std::sin(1.0 + k), 0.05 * std::sin(2.0 * k), 0.0); };
    for (int k = 0; k < 25; ++k) world.add_sphere(Vec3(2 * r * (k % 5), 2 * r * (k / 5), r), shaken(k));
    for (int k = 0; k < 16; ++k)
        world.add_sphere(Vec3(r + 2 * r * (k % 4), r + 2 * r * (k / 4), r * (1 + std::sqrt(2.0))), shaken(k));
    world.step(10000);
    CHECK(kinetic_energy(world.state) < 1e-8 * 41 * mass_of(r) * g * d);
}

TEST_CASE("attraction between spheres, and with a piston, keeps momentum", "[attraction]")
{
    World world = make_world({}, GENERATE(rigid_settings(), matched_settings()), step);
    world.model.gravity.setZero();
    world.attract({.force = 0.01, .range = 0.2 * d});
    world.add_sphere(r * Vec3::UnitZ(), 0.02 * Vec3::UnitZ());
    world.add_sphere(3.0 * r * Vec3::UnitZ(), 0.05 * Vec3::UnitZ(), Vec3::Zero(), r);
    world.add_piston(Disk{Vec3::Zero(), Vec3::UnitZ(), 5.0 * r, 0.0}, 3.0 * mass_of(r), Vec3::UnitZ());
    world.state.pistons[0].velocity = -0.01 * Vec3::UnitZ();
    const double before = world.momentum().z(), piston = world.state.pistons[0].velocity.z();
    world.step(20);
    CHECK(world.state.pistons[0].velocity.z() > piston + 1e-3);
    CHECK(world.momentum().z() == Approx(before).epsilon(1e-12));
}

} // namespace talus::test
