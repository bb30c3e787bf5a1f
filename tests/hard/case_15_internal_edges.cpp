// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "flat_mesh.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace talus;
using namespace talus::test;

// Spheres on a flat floor of triangles. Who takes each triangle, or each edge, for a contact of its own feels the edges
// from inside: at an edge ahead the nearest point of the next triangle lies before the sphere, and its normal points
// against the way. At a few m/s that is a kick at every edge.

namespace
{

constexpr double d = 2 * standard_radius;
constexpr double speed = 2.0; // m/s
constexpr double friction = 0.5;
constexpr double length = 2.0; // m

const Eigen::Matrix3d oblique = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.7).normalized()).toRotationMatrix();

/// What a floor did to a sphere that ran over it.
struct Ride {
    double bump = 0.0;        ///< largest change of its height [d]
    double speed_error = 0.0; ///< at the end, of what the law says, relative
    double spin_error = 0.0;  ///< of r ω at the end, relative
    double sideways = 0.0;    ///< farthest from the line of its way [d]

    void keep_worst(const Ride& other)
    {
        bump = std::max(bump, other.bump);
        speed_error = std::max(speed_error, other.speed_error);
        spin_error = std::max(spin_error, other.spin_error);
        sideways = std::max(sideways, other.sideways);
    }
};

enum class Start { rolling, sliding, frictionless };

/// A sphere that has come to rest at the beginning of a floor, whose normal is the turned z axis, is set in motion
/// along the turned x axis and runs over 0.9 of its length.
Ride ride(const std::vector<Shape>& floors, const Eigen::Matrix3d& turn, Start start, double restitution = 0.0,
    Stabilisation law = Stabilisation::matched)
{
    World world =
        production_world({.friction = start == Start::frictionless ? 0.0 : friction, .restitution = restitution}, law);
    world.model.gravity = turn * world.model.gravity;
    for (const auto& floor : floors) world.add_wall(floor);
    // A trace too deep: exactly on the surface, rounding would decide when it begins to sink into its overlap.
    world.add_sphere(turn * Vec3(-0.45 * length, 0, (1.0 - 1e-6) * standard_radius));
    world.step(1000);
    const auto here = [&] { return Vec3(turn.transpose() * world.position()); };
    const Vec3 begin = here();
    world.state.body(0).velocity += turn * Vec3(speed, 0, 0);
    if (start == Start::rolling) world.state.body(0).rim_velocity = turn * Vec3(0, speed, 0);
    Ride ride;
    while (here().x() < 0.45 * length) {
        const double time = world.state.time;
        world.step();
        ride.bump = std::max(ride.bump, std::abs(here().z() - begin.z()) / d);
        ride.sideways = std::max(ride.sideways, std::abs(here().y() - begin.y()) / d);
        if (time > 10.0) break; // it stopped on its way: the speed tells
    }
    const double end = start == Start::sliding ? 5.0 / 7.0 * speed : speed;
    const Vec3 rim = start == Start::frictionless ? Vec3::Zero() : Vec3(0, end, 0);
    ride.speed_error = (turn.transpose() * world.velocity() - Vec3(end, 0, 0)).norm() / end;
    ride.spin_error = (turn.transpose() * world.state.body(0).rim_velocity - rim).norm() / end;
    return ride;
}

/// Two floors, each a wall of its own, that meet at a right angle to the way.
std::vector<Shape> joined_floors(double jump = 0.0)
{
    return {box_panels({Vec3(-length, -0.1, -0.1), Vec3(0, 0.1, 0)}, {}),
        box_panels({Vec3(0, -0.1, -0.1), Vec3(length, 0.1, jump)}, {})};
}

/// Squares along the way (which then is an edge, from corner to corner), across it and at angles to it; one diagonal,
/// the other, or both; corners in rows or anywhere.
std::vector<FlatMesh> orientations(double cell)
{
    std::vector<FlatMesh> meshes;
    for (const double degrees : {0.0, 7.0, 26.565051177, 45.0, 71.0})
        for (const auto* diagonals : {"rising", "falling", "mixed"})
            for (const double jitter : {0.0, 0.3})
                meshes.push_back(
                    {length, std::max(0.02, 3 * cell), cell, degrees * std::numbers::pi / 180, diagonals, jitter});
    return meshes;
}

void judge(HardCase& hard, const std::string& what, const Ride& worst)
{
    hard.below(what + ": bump [d]", worst.bump, 1e-10);
    hard.below(what + ": speed at the end, error", worst.speed_error, 1e-11);
    hard.below(what + ": spin at the end, error", worst.spin_error, 1e-11);
    hard.below(what + ": off its line [d]", worst.sideways, 1e-8);
}

} // namespace

TEST_CASE("15 over the internal edges of a flat floor", "[hard]")
{
    // Triangles smaller and larger than the sphere, level and at an angle to all axes, where what is flat is so up to
    // rounding only. Rolling keeps its speed, sliding ends at 5/7 of it, and without friction nothing changes at all.
    HardCase hard("15 over the internal edges of a flat floor");
    Ride rolling, sliding, frictionless, rebounding, projected;
    std::size_t fewest = 1000000;
    for (const double cell : {0.001, 0.0123})
        for (const auto& strip : orientations(cell)) {
            const Mesh level = make_flat_mesh(strip);
            const Shape floor = turned(level, oblique);
            if (cell == 0.001) fewest = std::min(fewest, edge_count(level));
            for (const auto& [shape, turn] : {std::pair<Shape, Eigen::Matrix3d>(level, Eigen::Matrix3d::Identity()),
                     std::pair<Shape, Eigen::Matrix3d>(floor, oblique)}) {
                rolling.keep_worst(ride({shape}, turn, Start::rolling));
                sliding.keep_worst(ride({shape}, turn, Start::sliding));
                frictionless.keep_worst(ride({shape}, turn, Start::frictionless));
                rebounding.keep_worst(ride({shape}, turn, Start::rolling, 0.8));
                projected.keep_worst(ride({shape}, turn, Start::sliding, 0.0, Stabilisation::projected));
            }
        }
    hard.above("edges of a finer floor, of which a ride crosses some thousands", static_cast<double>(fewest), 1e4);
    judge(hard, "rolling", rolling);
    judge(hard, "sliding, then rolling", sliding);
    judge(hard, "without friction", frictionless);
    judge(hard, "rolling, restitution 0.8", rebounding);
    judge(hard, "sliding, projected", projected);
}

TEST_CASE("15 over floors that are flat but for their files, or joined", "[hard]")
{
    // What is flat in a drawing is so to 32 bits in an STL file: 3e-8 of its size, here 6e-8 m. And where two walls
    // meet, each has a contact of its own.
    HardCase hard("15 over floors that are flat but for their files, or joined");
    Ride stl;
    for (const auto& strip : orientations(0.0123))
        stl.keep_worst(ride({as_in_stl(turned(make_flat_mesh(strip), oblique))}, oblique, Start::rolling));
    hard.below("rolling, STL: bump [d]", stl.bump, 1e-3);
    hard.below("rolling, STL: speed at the end, error", stl.speed_error, 1e-3);
    hard.below("rolling, STL: off its line [d]", stl.sideways, 0.1);
    const Ride joined = ride(joined_floors(), Eigen::Matrix3d::Identity(), Start::rolling);
    hard.tell("rolling, over the joint of two walls: bump [d]", joined.bump);
    hard.tell("rolling, over the joint of two walls: speed at the end, error", joined.speed_error);
}
