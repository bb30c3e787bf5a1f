// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double r = standard_radius;

/// The box from corner to corner, each face of two triangles.
Mesh box_mesh(const Vec3& min, const Vec3& max)
{
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back(k & 1 ? max.x() : min.x(), k & 2 ? max.y() : min.y(), k & 4 ? max.z() : min.z());
    return make_mesh(corners, {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                  {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}});
}

/// The ways to build a corner at the origin whose faces look towards +x, +y and +z.
std::vector<std::pair<std::string, std::vector<Shape>>> corners()
{
    const Vec3 max = Vec3::Constant(0.1);
    return {{"planes", {Plane{Vec3::Zero(), Vec3::UnitX()}, Plane{Vec3::Zero(), Vec3::UnitY()},
                           Plane{Vec3::Zero(), Vec3::UnitZ()}}},
        {"box", {box_panels({Vec3::Zero(), max}, {})}}, {"mesh", {box_mesh(Vec3::Zero(), max)}}};
}

/// A table whose top ends at x = 0.
std::vector<std::pair<std::string, Shape>> tables()
{
    const Vec3 min(-0.5, -0.1, -0.2), max(0, 0.1, 0);
    return {{"box", box_panels({min, max}, {})}, {"mesh", box_mesh(min, max)}};
}

} // namespace

TEST_CASE("16 a sphere in a concave corner", "[hard][quick]")
{
    // Gravity points into the corner, at the same angle to its two or three faces: m g/sqrt(2) or m g/sqrt(3) on each,
    // exactly so without friction; with it only the sum is determined. The triangles of a face, and the edge where
    // faces meet, must not push a second time.
    HardCase hard("16 a sphere in a concave corner");
    for (const int faces : {2, 3})
        for (const double friction : {0.0, 0.5})
            for (const auto& [name, shapes] : corners()) {
                World world = production_world({.friction = friction});
                const Vec3 down = -(faces == 2 ? Vec3(1, 0, 1) : Vec3(1, 1, 1)).normalized();
                world.model.gravity = standard_gravity * down;
                for (const auto& shape : shapes) world.add_wall(shape);
                world.add_sphere(Vec3(1.01 * r, faces == 2 ? 0.0333 : 1.01 * r, 1.01 * r));
                world.step(4000);
                const Vec3 begin = world.position();
                world.step(4000);
                const double weight = world.mass() * standard_gravity;
                double error = 0.0, beyond_cone = 0.0;
                Vec3 sum = weight * down;
                for (const auto& force : world.contact_forces()) {
                    sum += force.normal_force * force.normal + force.tangent_force;
                    beyond_cone =
                        std::max(beyond_cone, force.tangent_force.norm() - force.friction * force.normal_force);
                    if (friction > 0.0 || force.normal_force == 0.0) continue;
                    error = std::max(error, std::abs(force.normal_force / weight * std::sqrt(double(faces)) - 1.0));
                }
                const std::string what = std::to_string(faces) + (friction > 0 ? " rough " : " smooth ") + name + ": ";
                hard.between(what + "contacts", static_cast<double>(world.report.contacts.count), faces, faces);
                if (friction == 0.0) hard.below(what + "force on each, error", error, 1e-6);
                hard.below(what + "friction beyond the cone [weight]", beyond_cone / weight, 1e-12);
                hard.below(what + "sum of the forces [weight]", sum.norm() / weight, 1e-6);
                hard.below(what + "drift [d/s]",
                    (world.position() - begin).norm() / (2 * r) / (4000 * world.model.time_step), 1e-9);
            }
}

TEST_CASE("16 a sphere rolls off a convex edge", "[hard][quick]")
{
    // Slowly, it turns about the edge without slip and leaves it where the edge would have to pull: from an angle
    // theta_0 at rest, 7/10 v^2 = g r (cos theta_0 - cos theta) and v^2 = g r cos theta give cos theta = 10/17 cos
    // theta_0, and v_x = v cos theta stays. Fast, v^2 > g r, it goes on straight at once. A contact whose normal jumps
    // from the top's to the side's at the edge, or that gives its overlap back there, would kick.
    HardCase hard("16 a sphere rolls off a convex edge");
    for (const auto& [name, shape] : tables()) {
        World world = production_world({.friction = 10.0});
        world.add_wall(shape);
        const double start_angle = 0.1;
        world.add_sphere(r * Vec3(std::sin(start_angle), 0, std::cos(start_angle)));
        const auto energy = [&] {
            return kinetic_energy(world.state) + potential_energy(world.state, world.model.gravity);
        };
        const double scale = world.mass() * standard_gravity * r;
        double last = energy(), rise = 0.0;
        while (world.position().z() > -2 * r && world.state.steps < 10000) {
            world.step();
            rise = std::max(rise, (energy() - last) / scale);
            last = energy();
        }
        const double level = 10.0 / 17.0 * std::cos(start_angle);
        const double expected = std::sqrt(standard_gravity * r * level) * level;
        hard.below(
            "slowly, " + name + ": horizontal speed, error", std::abs(world.velocity().x() / expected - 1.0), 0.03);
        hard.below("slowly, " + name + ": spin, error",
            std::abs(world.state.body(0).rim_velocity.y() / std::sqrt(standard_gravity * r * level) - 1.0), 0.03);
        hard.below("slowly, " + name + ": sideways [m/s]", std::abs(world.velocity().y()), 1e-9);
        hard.below("slowly, " + name + ": rise of the energy in a step [m g r]", rise, 1e-6);

        World fast = production_world({.friction = 0.5});
        fast.add_wall(shape);
        fast.add_sphere(Vec3(-0.3, 0, r));
        fast.step(1000);
        fast.state.body(0).velocity.x() = fast.state.body(0).rim_velocity.y() = 1.0;
        double upwards = -infinity;
        while (fast.position().x() < 2 * r) {
            fast.step();
            if (fast.position().x() > -r) upwards = std::max(upwards, fast.velocity().z());
        }
        const double in_a_step = standard_gravity * fast.model.time_step;
        hard.below("fast, " + name + ": change of horizontal speed [g h]",
            std::abs(fast.velocity().x() - 1.0) / in_a_step, 0.1);
        hard.below("fast, " + name + ": change of r x spin [g h]",
            std::abs(fast.state.body(0).rim_velocity.y() - 1.0) / in_a_step, 0.1);
        hard.below("fast, " + name + ": speed upwards at the edge [g h]", upwards / in_a_step, 0.1);
    }
}
