// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

/// A sphere on the floor, and one of `ratio` times its mass that falls on it with 1 m/s.
/// @param move that of the heavy one in a step; @param start the gap between them, both in diameters of the light one
World squeezed(double ratio, double restitution, double move, double start)
{
    const double d = 2 * standard_radius, heavy_radius = standard_radius * std::cbrt(ratio);
    World world = make_world({0.0, restitution, 0.0, infinity}, production_settings(Stabilisation::matched), move * d);
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = automatic_push_out_speed();
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0, 0, standard_radius));
    world.add_sphere(Vec3(0, 0, d + start * d + heavy_radius), Vec3(0, 0, -1), Vec3::Zero(), heavy_radius);
    return world;
}

/// Until the heavy one has come back by some diameters. Returns the most kinetic energy on the way [J].
double squeeze(World& world, double move)
{
    double most = kinetic_energy(world.state);
    const auto step = [&] {
        world.step();
        most = std::max(most, kinetic_energy(world.state));
    };
    for (int n = 0; n < 20000 && world.velocity(1).z() < 0.01; ++n) step();
    for (int n = 0; n < 3 / move; ++n) step();
    return most;
}

} // namespace

TEST_CASE("a heavy ball that meets a light one on the floor gets no energy, and does not pass it",
    "[law][!mayfail]")
{
    // What pushing out adds is reported in the books; 0.5 % at most here.
    const double ratio = GENERATE(100.0, 3000.0), e = GENERATE(0.0, 0.4, 0.9);
    const double push_out_speed = GENERATE(0.0, automatic_push_out_speed());
    const double move = GENERATE(0.003, 0.01, 0.1, 0.3), start = GENERATE(0.001, 0.013, 0.027, 0.31, 0.5);
    CAPTURE(ratio, e, push_out_speed, move, start);
    World world = squeezed(ratio, e, move, start);
    world.model.solver.push_out_speed = push_out_speed;
    const double energy = kinetic_energy(world.state), most = squeeze(world, move);
    CHECK(most <= (push_out_speed > 0.0 ? 1.005 : 1.0001) * energy);
    CHECK(world.position(0).z() > 0.0);
    CHECK(world.position(1).z() > std::cbrt(ratio) * standard_radius);
}

} // namespace talus::test
