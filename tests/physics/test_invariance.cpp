// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace talus::test
{
namespace
{

constexpr double time_step = 2.5e-4;

struct Body {
    Vec3 position, velocity, spin;
    double radius;
};

ContactLaw everything()
{
    ContactLaw law;
    law.friction = 0.4;
    law.restitution = 0.6;
    law.rolling_friction = 0.05;
    return law;
}

/// A handful of spheres of several sizes thrown into a corner of floor and walls.
const std::vector<Body> bodies = {
    {{0.000, 0.001, 0.012}, {0.3, 0.0, -0.2}, {0, 50, 10}, 0.005},
    {{0.012, 0.000, 0.008}, {-0.2, 0.1, 0.0}, {20, 0, 0}, 0.004},
    {{0.004, 0.003, 0.024}, {0.1, 0.0, -0.6}, {0, 0, -40}, 0.006},
    {{-0.01, 0.002, 0.011}, {0.2, -0.1, 0.1}, {5, 5, 5}, 0.003},
    {{0.013, 0.004, 0.020}, {0.0, 0.0, -0.4}, {0, -30, 0}, 0.005},
};

/// The corner seen in another frame: x ↦ transform x, with spins turned as axial vectors.
World corner(const Eigen::Matrix3d& transform, const SolverSettings& solver)
{
    World world = make_world(everything(), solver, time_step);
    world.model.gravity = transform * world.model.gravity;
    world.add_plane(Vec3::Zero(), transform * Vec3::UnitZ());
    world.add_plane(transform * Vec3(0.02, 0, 0), transform * -Vec3::UnitX());
    world.add_plane(transform * Vec3(-0.015, 0, 0), transform * Vec3(0.8, 0, 0.6));
    const double handedness = transform.determinant();
    for (const Body& body : bodies)
        world.add_sphere(
            transform * body.position, transform * body.velocity, handedness * (transform * body.spin), body.radius);
    return world;
}

Eigen::Matrix3d rotation(double angle, const Vec3& axis)
{
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Four spheres on a floor: three apart from each other, the fourth let down on them, so that its forces are unique.
World pyramid(const std::array<int, 4>& order, const SolverSettings& solver)
{
    const double r = standard_radius;
    const std::array<Vec3, 4> centers = {
        Vec3(1.25 * r, 0, r), Vec3(-0.6 * r, 1.1 * r, r), Vec3(-0.65 * r, -1.12 * r, r), Vec3(0, 0, 2.7 * r)};
    ContactLaw law;
    law.friction = 0.8;
    World world = make_world(law, solver, time_step);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (const int k : order) world.add_sphere(centers[k], Vec3(0, 0, k == 3 ? -0.1 : 0.0));
    return world;
}

} // namespace

TEST_CASE("a rotated scene gives the rotated result, a mirrored one the mirrored", "[invariance]")
{
    // Tangential impulses live on a disk in the tangent plane, without a basis. The tiles, and with them the order of
    // the sweeps, do change, so steps are solved to 1e-13; some bounces and rolls later 1e-9 r of it is left.
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    const Eigen::Matrix3d mirror = Vec3(1, -1, 1).asDiagonal();
    const Eigen::Matrix3d transform = GENERATE_COPY(rotation(0.7, Vec3(1, 2, 3)), rotation(2.5, Vec3(-1, 0.3, 0)),
        Eigen::Matrix3d(mirror), Eigen::Matrix3d(rotation(1.2, Vec3(0, 1, 1)) * mirror));
    World world = corner(Eigen::Matrix3d::Identity(), solver);
    World turned = corner(transform, solver);
    std::size_t contacts = 0;
    for (int step = 0; step < 1200; ++step) {
        world.step();
        turned.step();
        contacts += world.report.contacts.count;
    }
    REQUIRE(contacts > 200);
    const double handedness = transform.determinant();
    for (int id = 0; id < static_cast<int>(bodies.size()); ++id) {
        CHECK((turned.position(id) - transform * world.position(id)).norm() < 1e-9 * standard_radius);
        CHECK((turned.velocity(id) - transform * world.velocity(id)).norm() < 1e-9);
        CHECK((turned.angular_velocity(id) - handedness * (transform * world.angular_velocity(id))).norm() <
              1e-6); // ω ~ 1e2
    }
}

TEST_CASE("a scene moved by a vector gives the moved result", "[invariance]")
{
    const Vec3 shift(10, -20, 5); // 1e3 r: costs three digits of a position's round-off
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    World world = corner(Eigen::Matrix3d::Identity(), solver);
    World moved = world;
    for (Vec3& position : moved.state.position) position += shift;
    for (Wall& wall : moved.model.walls) std::get<Plane>(wall.shape).point += shift;
    world.step(200);
    moved.step(200);
    for (int id = 0; id < static_cast<int>(bodies.size()); ++id) {
        CHECK((moved.position(id) - shift - world.position(id)).norm() < 1e-7 * standard_radius);
        CHECK((moved.velocity(id) - world.velocity(id)).norm() < 1e-7);
    }
}

TEST_CASE("renumbering the spheres changes nothing beyond the tolerance", "[invariance]")
{
    // The order of sweeps changes, the unique solution does not: steps solved to 1e-13 agree to 1e-9 after 100 of them.
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    World world = pyramid({0, 1, 2, 3}, solver);
    world.step(100);
    auto order = GENERATE(values<std::array<int, 4>>({{3, 2, 1, 0}, {1, 3, 0, 2}, {2, 0, 3, 1}}));
    World renumbered = pyramid(order, solver);
    renumbered.step(100);
    for (int id = 0; id < 4; ++id) {
        CHECK((renumbered.position(id) - world.position(order[id])).norm() < 1e-9 * standard_radius);
        CHECK((renumbered.velocity(id) - world.velocity(order[id])).norm() < 1e-9);
    }
}

} // namespace talus::test
