// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double length = 0.06; ///< of the cell, six diameters [m]
constexpr double time_step = 2e-4;

Periodicity along_x()
{
    return {Vec3::Zero(), Vec3(length, infinity, infinity)};
}

Periodicity along_x_and_y()
{
    return {Vec3(-0.01, 0, 0), Vec3(length, 0.05, infinity)};
}

World without_gravity(const ContactLaw& law, const SolverSettings& solver, const Periodicity& periodicity)
{
    World world = make_world(law, solver, time_step);
    world.model.gravity.setZero();
    world.model.periodicity = periodicity;
    return world;
}

/// A cloud of spheres that collide in the middle of the cell, moved as a whole.
World colliding_cloud(
    const Vec3& shift, const ContactLaw& law, const SolverSettings& solver, const Periodicity& periodicity)
{
    World world = without_gravity(law, solver, periodicity);
    for (int k = 0; k < 8; ++k) {
        const Vec3 from_middle(0.013 * (k % 2) - 0.0065, 0.012 * (k / 2 % 2) - 0.006, 0.012 * (k / 4) - 0.006);
        const Vec3 place = periodicity.origin + 0.5 * Vec3(length, 0.05, 0) + from_middle;
        world.add_sphere(periodicity.wrapped(place + shift), -20.0 * from_middle + Vec3(0.01 * k, 0.02 * (k % 3), 0),
            Vec3(30.0 - k, 10, -20), 0.004 + 0.0001 * k);
    }
    return world;
}

} // namespace

TEST_CASE("bodies that collide across a periodic border do as those in the middle of the cell", "[periodicity]")
{
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    const auto periodicity = GENERATE(along_x(), along_x_and_y());
    const ContactLaw law{.friction = 0.4, .restitution = 0.5, .rolling_friction = 0.02};
    World middle = colliding_cloud(Vec3::Zero(), law, solver, periodicity);
    World border = colliding_cloud(Vec3(0.5 * length, periodicity.along(1) ? 0.025 : 0.0, 0), law, solver, periodicity);
    std::size_t contacts = 0;
    const Vec3 momentum = linear_momentum(border.state);
    const double energy = kinetic_energy(border.state);
    for (int step = 0; step < 500; ++step) {
        middle.step();
        border.step();
        contacts += border.report.contacts.count;
    }
    REQUIRE(contacts > 10);
    CHECK(kinetic_energy(border.state) < 0.9 * energy);
    CHECK((linear_momentum(border.state) - momentum).norm() < 1e-12 * momentum.norm() + 1e-15);
    for (int id = 0; id < 8; ++id) {
        CHECK((middle.velocity(id) - border.velocity(id)).norm() < 1e-8);
        CHECK((middle.angular_velocity(id) - border.angular_velocity(id)).norm() < 1e-5); // ω ~ 1e2
        const Vec3 apart =
            border.position(id) - middle.position(id) - Vec3(0.5 * length, periodicity.along(1) ? 0.025 : 0.0, 0);
        CHECK(periodicity.nearest_image(apart).norm() < 1e-8);
    }
}

TEST_CASE("a cell 2.2 diameters long along all three axes does as eight of them side by side", "[periodicity]")
{
    // Three spheres of different sizes that fly about and collide, each with images of the others and, in the large
    // cell, with their copies. The law has one answer, so that the orders of sweeps do not matter.
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    const double edge = 2.2 * 0.01;
    World small = without_gravity({.restitution = 0.8}, solver, {Vec3::Zero(), Vec3::Constant(edge)});
    World large = without_gravity({.restitution = 0.8}, solver, {Vec3::Zero(), Vec3::Constant(2.0 * edge)});
    const std::vector<Vec3> places = {Vec3(0.001, 0.002, 0.021), Vec3(0.012, 0.004, 0.011), Vec3(0.005, 0.015, 0.009)};
    const std::vector<Vec3> velocities = {Vec3(0.3, 0.1, -0.2), Vec3(-0.4, 0.2, 0.15), Vec3(0.1, -0.5, 0.3)};
    const std::vector<double> radii = {0.005, 0.0043, 0.0036};
    for (std::size_t k = 0; k < 3; ++k) small.add_sphere(places[k], velocities[k], Vec3::Zero(), radii[k]);
    for (int copy = 0; copy < 8; ++copy)
        for (std::size_t k = 0; k < 3; ++k)
            large.add_sphere(
                places[k] + edge * Vec3(copy & 1, copy >> 1 & 1, copy >> 2), velocities[k], Vec3::Zero(), radii[k]);
    int impacts = 0;
    for (int step = 0; step < 2500; ++step) {
        const Vec3 before = small.velocity(0);
        small.step();
        large.step();
        impacts += (small.velocity(0) - before).norm() > 1e-3;
    }
    REQUIRE(impacts > 10);
    for (int id = 0; id < 24; ++id) {
        CHECK((large.velocity(id) - small.velocity(id % 3)).norm() < 1e-6);
        const Vec3 apart = large.position(id) - small.position(id % 3);
        CHECK(small.model.periodicity.nearest_image(apart).norm() < 1e-6);
    }
}

TEST_CASE("a free sphere comes in again on the other side with its velocity", "[periodicity]")
{
    World world = without_gravity({}, rigid_settings(), along_x_and_y());
    world.add_sphere(Vec3(0, 0.01, 0), Vec3(-7, 3, 1));
    for (int step = 1; step <= 1000; ++step) {
        world.step();
        const Vec3 free = Vec3(0, 0.01, 0) + step * time_step * Vec3(-7, 3, 1);
        REQUIRE(world.model.periodicity.nearest_image(world.position() - free).norm() < 1e-12);
        REQUIRE(world.position().x() >= -0.01);
        REQUIRE(world.position().x() < 0.05);
    }
    CHECK(world.velocity() == Vec3(-7, 3, 1));
    CHECK(world.position().z() == Approx(0.2));
}

TEST_CASE("a ring of spheres pressed together round a periodic axis pushes itself apart nowhere", "[periodicity]")
{
    // Six spheres of 10.1 mm in a cell of 60 mm overlap each neighbour by 0.1 mm, the last the first across the border:
    // by symmetry nothing moves, and every contact carries the same. The position pass of `projected` takes one pair
    // after the other: it passes the overlap on, which has no room to go, by a quarter of it at most.
    const double passed_on = 2.5e-5;
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    World world = without_gravity({.friction = 0.5}, solver, along_x());
    for (int k = 0; k < 6; ++k) world.add_sphere(Vec3(0.002 + 0.01 * k, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.00505);
    world.step(50);
    CHECK(world.report.contacts.count == 6);
    const bool rigid = solver.stabilisation == Stabilisation::projected;
    CHECK(world.report.contacts.worst_overlap == Approx(1e-4).margin(rigid ? 2 * passed_on : 1e-10));
    for (int k = 0; k < 6; ++k) {
        CHECK(world.velocity(k).norm() < 1e-9);
        CHECK((world.position(k) - Vec3(0.002 + 0.01 * k, 0, 0)).norm() < (rigid ? passed_on : 1e-9));
    }
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 6);
    for (const auto& force : forces) {
        CHECK(std::abs(std::abs(force.normal.x()) - 1.0) < 1e-9);
        CHECK(force.normal_force == Approx(forces[0].normal_force).margin(1e-9));
    }
}

TEST_CASE("overlap across a periodic border is undone as anywhere else", "[periodicity]")
{
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    const auto gap_after = [&](const Vec3& middle) {
        World world = without_gravity({}, solver, along_x());
        const Vec3 half(0.0048, 0.0004, 0);
        world.add_sphere(world.model.periodicity.wrapped(middle + half));
        world.add_sphere(world.model.periodicity.wrapped(middle - half));
        world.step(20);
        return world.model.periodicity.nearest_image(world.position(0) - world.position(1));
    };
    const Vec3 inside = gap_after(Vec3(0.5 * length, 0, 0)), across = gap_after(Vec3(0, 0, 0));
    CHECK((inside - across).norm() < 1e-14);
    CHECK(across.norm() > 0.009999);
    CHECK(across.x() > 0.0);
}

TEST_CASE("walls that span a periodic cell have no seam", "[periodicity][walls]")
{
    // A sphere that slides without friction along a floor of panels, a mesh whose triangles end at the border, a tube,
    // or across two borders; for four cells.
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    const auto [shape, velocity] = GENERATE(table<int, Vec3>({{0, Vec3(0.9, 0.0, 0)}, {0, Vec3(-1.1, 0.2, 0)},
        {1, Vec3(0.9, 0.0, 0)}, {1, Vec3(-1.3, 0.7, 0)}, {2, Vec3(1, 0, 0)}, {2, Vec3(-2.0, 0, 0)}}));
    World world = make_world({}, solver, time_step);
    world.model.periodicity = along_x_and_y();
    if (shape == 2) world.model.periodicity.length.y() = infinity;
    const Vec3 low = world.model.periodicity.origin, high = low + Vec3(length, 0.05, 0);
    if (shape == 0) world.add_wall(box_panels({low, Vec3(high + 0.1 * Vec3::UnitZ())}, {"x-", "x+", "y-", "y+", "z+"}));
    if (shape == 1)
        world.add_wall(
            make_mesh({low, Vec3(high.x(), low.y(), 0), high, Vec3(low.x(), high.y(), 0), Vec3(0.013, 0.02, 0)},
                {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
    if (shape == 2) world.add_wall(Cylinder{Vec3(low.x(), 0.02, 0.02), Vec3::UnitX(), 0.02, length});
    world.add_sphere(Vec3(0.0123, 0.02, standard_radius), velocity);
    world.step(200); // `matched` sinks in
    const double height = world.position().z();
    double worst_height = 0.0, worst_speed = 0.0;
    for (int k = 0; k < 1400; ++k) {
        world.step();
        worst_height = std::max(worst_height, std::abs(world.position().z() - height));
        worst_speed = std::max(worst_speed, (world.velocity() - velocity).norm());
        REQUIRE(world.report.contacts.count == 1);
    }
    CHECK(worst_height < 1e-9);
    CHECK(worst_speed < 1e-9);
    CHECK(height == Approx(standard_radius).epsilon(1e-3));
}

TEST_CASE("a wall across a periodic border is felt on both of its sides", "[periodicity][walls]")
{
    // A plate just inside of the border x = 0 is met by a sphere that comes from the other end of the cell.
    World world = without_gravity({.restitution = 1.0}, rigid_settings(), along_x());
    world.add_wall(Disk{Vec3(0.001, 0, 0), Vec3::UnitX(), 0.02});
    world.add_sphere(Vec3(0.04, 0, 0), Vec3(1, 0, 0)); // 16 mm from it
    world.step(200);
    CHECK(world.velocity().x() < 0.0);
    // It goes to and fro in the room of one cell less a diameter.
    double least = infinity, most = -infinity;
    for (int k = 0; k < 1000; ++k) {
        world.step();
        const double x = world.position().x() < 0.001 ? world.position().x() + length : world.position().x();
        least = std::min(least, x);
        most = std::max(most, x);
    }
    CHECK(least == Approx(0.001 + standard_radius).margin(2.1e-4));
    CHECK(most == Approx(0.001 + length - standard_radius).margin(2.1e-4));
}

TEST_CASE("gravity along a periodic axis does work and has no potential", "[periodicity][energy]")
{
    // A chute of periodic length: without friction v = g sin θ t for ever.
    World world = make_world({}, rigid_settings(), time_step);
    world.model.periodicity = along_x();
    world.model.gravity = Vec3(3.0, 0, -9.0);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0.01, 0, standard_radius));
    double work = 0.0;
    for (int k = 0; k < 3000; ++k) {
        world.step();
        work += world.report.bodies.gravity_work;
    }
    CHECK(world.velocity().x() == within(1e-9, 3.0 * 3000 * time_step));
    CHECK(world.report.bodies.potential_energy == within(1e-9, world.mass() * 9.0 * standard_radius));
    CHECK(work == within(1e-3, kinetic_energy(world.state))); // of the first order in h
}

} // namespace talus::test
