// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "flat_mesh.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
constexpr double cell = 0.008; // m

const Eigen::Matrix3d oblique = Eigen::AngleAxisd(0.8, Vec3(2, 1, -0.4).normalized()).toRotationMatrix();

/// How a sphere rests on a floor.
struct Rest {
    double force_error = 0.0; ///< worst of any step, of its weight
    double drift = 0.0;       ///< sideways [d/s]
    double spin = 0.0;        ///< r ω at the end [d/s]
    std::size_t contacts = 0; ///< most in any step

    void keep_worst(const Rest& other)
    {
        force_error = std::max(force_error, other.force_error);
        drift = std::max(drift, other.drift);
        spin = std::max(spin, other.spin);
        contacts = std::max(contacts, other.contacts);
    }
};

/// A sphere let go from 0.01 d above a place of the floor, whose normal is the turned z axis, watched for two seconds
/// after one.
Rest rest(const Mesh& floor, const Vec3& place, const Eigen::Matrix3d& turn)
{
    World world = production_world({.friction = 0.5});
    world.model.gravity = turn * world.model.gravity;
    world.add_wall(turned(floor, turn));
    world.add_sphere(turn * (place + 1.02 * standard_radius * Vec3::UnitZ()));
    const double h = world.model.time_step, weight = world.mass() * standard_gravity;
    world.step(static_cast<int>(1.0 / h));
    const Vec3 begin = world.position();
    const int steps = static_cast<int>(2.0 / h);
    Rest rest;
    for (int k = 0; k < steps; ++k) {
        world.step();
        const Vec3 force = turn.transpose() * world.report.outcome.from_walls.impulse / h;
        rest.force_error = std::max(rest.force_error, (force - weight * Vec3::UnitZ()).norm() / weight);
        rest.contacts = std::max(rest.contacts, world.report.contacts.count);
    }
    const Vec3 way = turn.transpose() * (world.position() - begin);
    rest.drift = way.head<2>().norm() / d / (steps * h);
    rest.spin = world.state.body(0).rim_velocity.norm() / d;
    return rest;
}

} // namespace

TEST_CASE("14 a sphere rests on an edge, a diagonal and a vertex of a mesh", "[hard][quick]")
{
    // Two triangles meet below it, or up to eight: if each pushed, or none, the force would be twice the weight, or
    // nothing; if one of several were chosen by chance from step to step, friction would let it creep. The same a
    // hair's breadth from there, and on a floor at an angle to all axes, where rounding decides on which triangle it
    // stands.
    HardCase hard("14 a sphere rests on an edge, a diagonal and a vertex of a mesh");
    const struct {
        std::string name;
        Vec3 at; // in cells
    } places[] = {{"on an edge", Vec3(0.37, 0, 0)}, {"on a diagonal", Vec3(0.3, 0.3, 0)},
        {"on a vertex", Vec3(0, 0, 0)}, {"in a triangle", Vec3(0.61, 0.23, 0)}};
    for (const auto& place : places) {
        Rest worst;
        for (const auto* diagonals : {"rising", "mixed"})
            for (const Vec3& aside : {Vec3(0, 0, 0), Vec3(1e-15, -1e-15, 0), Vec3(-1e-9, 1e-9, 0), Vec3(1e-7, 2e-7, 0)})
                for (const Eigen::Matrix3d& turn : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), oblique})
                    worst.keep_worst(
                        rest(make_flat_mesh({0.08, 0.08, cell, 0.0, diagonals}), cell * (place.at + aside), turn));
        hard.below(place.name + ": force on the floor, error", worst.force_error, 1e-6);
        hard.below(place.name + ": drift [d/s]", worst.drift, 1e-9);
        hard.below(place.name + ": spin [d/s]", worst.spin, 1e-9);
        hard.between(place.name + ": contacts", static_cast<double>(worst.contacts), 1, 1);
    }
}
