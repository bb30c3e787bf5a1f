// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
constexpr double speed = 100.0;    // m/s
constexpr double step = 1e-3;      // s: a move of 10 d
constexpr int places = 37;         // where in its way of a step the sphere is when it meets the wall
constexpr double plate = 0.1;      // half the edge of the plates [m]
constexpr double thickness = 1e-3; // m
const double push_out_speed = automatic_push_out_speed();

/// A block, or a plate where it is flat, of triangles.
Mesh block(const Vec3& min, const Vec3& max)
{
    std::vector<Vec3> vertices;
    for (int k = 0; k < 8; ++k)
        vertices.push_back(Vec3(k & 1 ? max.x() : min.x(), k & 2 ? max.y() : min.y(), k & 4 ? max.z() : min.z()));
    return make_mesh(vertices, {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                   {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}});
}

Mesh triangle_plate()
{
    return make_mesh({Vec3(-plate, -plate, 0), Vec3(plate, -plate, 0), Vec3(plate, plate, 0), Vec3(-plate, plate, 0)},
        {{0, 1, 2}, {0, 2, 3}});
}

struct Outcome {
    double lowest = infinity;    ///< centre above the wall [m]
    double speed_error = 0.0;    ///< of the speed away from the wall, against e times that towards it
    double sideways_error = 0.0; ///< of the speed along the wall
};

/// Throws a sphere at the wall from all places.
Outcome throw_at(const Mesh& wall, double e, Stabilisation stabilisation, const Vec3& velocity)
{
    Outcome outcome;
    for (int k = 0; k < places; ++k) {
        World world = make_world({0.0, e, 0.0, infinity}, production_settings(stabilisation), step);
        world.model.gravity = Vec3::Zero();
        world.model.solver.push_out_speed = push_out_speed;
        world.add_wall(wall);
        const double height = standard_radius - (0.3 + (k + 0.5) / places) * step * velocity.z();
        const Vec3 aim(0.3 * d, 0.2 * d, 0);
        world.add_sphere(aim + Vec3(height / velocity.z() * velocity.x(), 0, height), velocity);
        for (int n = 0; n < 4; ++n) {
            world.step();
            outcome.lowest = std::min(outcome.lowest, world.position().z());
        }
        const Vec3 v = world.velocity();
        outcome.speed_error = std::max(outcome.speed_error, std::abs(v.z() / -velocity.z() - e));
        outcome.sideways_error = std::max(outcome.sideways_error, std::abs(v.x() - velocity.x()) / speed);
    }
    return outcome;
}

} // namespace

TEST_CASE("9 a fast sphere meets a thin wall", "[hard][quick]")
{
    // It moves 10 d in a step of 1 ms, so where positions are looked at only once a step it goes through 95 of 100
    // walls of 1 mm, and the step is split into a hundred. The criterion: nowhere in its way does its centre come to
    // the other side, and with e = 1 it has its speed back to 1e-6. With e = 0 `projected` gives nothing back, and
    // `matched` what its law does at any speed, up to 0.07 of what the last of the gap leaves.
    HardCase hard("9 a fast sphere meets a thin wall");
    const Mesh thin = block(Vec3(-plate, -plate, -thickness), Vec3(plate, plate, 0)), flat = triangle_plate();
    const Vec3 head_on(0, 0, -speed), aslant(0.6 * speed, 0, -0.8 * speed);
    for (const auto stabilisation : {Stabilisation::matched, Stabilisation::projected})
        for (const double e : {0.0, 1.0}) {
            Outcome worst;
            for (const Mesh& wall : {thin, flat})
                for (const Vec3& velocity : {head_on, aslant}) {
                    const auto outcome = throw_at(wall, e, stabilisation, velocity);
                    worst.lowest = std::min(worst.lowest, outcome.lowest);
                    worst.speed_error = std::max(worst.speed_error, outcome.speed_error);
                    worst.sideways_error = std::max(worst.sideways_error, outcome.sideways_error);
                }
            const std::string which = std::string(e > 0 ? ", e = 1, " : ", e = 0, ") + name_of(stabilisation);
            hard.above("lowest centre above the wall" + which + " [r]", worst.lowest / standard_radius, 0.85);
            hard.below("error of the speed away from it" + which + " [speed]", worst.speed_error,
                e == 0 && stabilisation == Stabilisation::matched ? 0.038 : 1e-6);
            hard.below("error of the speed along it" + which + " [speed]", worst.sideways_error, 1e-6);
        }
}

TEST_CASE("9 two fast spheres meet", "[hard][quick]")
{
    // Each moves 10 d in the step, so they would pass through each other. With e = 1 they exchange their velocities,
    // with e = 0 they stop, but for what `matched` gives back by (4) of what the last of the gap leaves: 1 becomes
    // -0.192, 0.041, 0.069 in three steps. Momentum is kept.
    HardCase hard("9 two fast spheres meet");
    for (const double e : {0.0, 1.0}) {
        double worst = 0.0, momentum = 0.0, least_gap = infinity;
        for (int k = 0; k < places; ++k) {
            World world = make_world({0.0, e, 0.0, infinity}, production_settings(Stabilisation::matched), step);
            world.model.gravity = Vec3::Zero();
            world.model.solver.push_out_speed = push_out_speed;
            const double way = standard_radius + (0.3 + (k + 0.5) / places) * speed * step;
            world.add_sphere(Vec3(-way, 0, 0), Vec3(speed, 0, 0));
            world.add_sphere(Vec3(way, 0, 0), Vec3(-speed, 0, 0));
            for (int n = 0; n < 4; ++n) {
                world.step();
                least_gap = std::min(least_gap, world.position(1).x() - world.position(0).x());
            }
            worst = std::max(
                {worst, std::abs(world.velocity(0).x() / speed + e), std::abs(world.velocity(1).x() / speed - e)});
            momentum = std::max(momentum, world.momentum().norm() / (world.mass() * speed));
        }
        const std::string which = e > 0 ? ", e = 1" : ", e = 0";
        hard.above("least distance of centres" + which + " [d]", least_gap / d, 0.9);
        hard.below("error of their velocities" + which + " [speed]", worst, e > 0 ? 1e-6 : 0.069);
        hard.below("momentum" + which + " [m x speed]", momentum, 1e-12);
    }
}
