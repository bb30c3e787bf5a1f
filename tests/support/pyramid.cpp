// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/pyramid.hpp"

#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double spacing = 2.1 * standard_radius; ///< s: bases that touched would add a self-stress of any size

/// Radius of the circle on which n base centres stand s apart.
double base_circle(int n)
{
    return spacing / (2.0 * std::sin(std::numbers::pi / n));
}

double upper_angle(int n)
{
    return std::asin(base_circle(n) / (2.0 * standard_radius));
}

/// From the middle to base sphere k. Two lie exactly in the plane y = 0: out of it their pyramid is unstable.
Vec3 base_direction(int n, int k)
{
    if (n == 2) return k == 0 ? Vec3::UnitX().eval() : Vec3(-Vec3::UnitX());
    const double angle = 2.0 * std::numbers::pi * k / n;
    return {std::cos(angle), std::sin(angle), 0};
}

} // namespace

double critical_friction_above(int n)
{
    return std::tan(0.5 * upper_angle(n));
}

double critical_friction_at_floor(int n)
{
    return std::tan(0.5 * upper_angle(n)) / (n + 1);
}

World pyramid(int n, double friction_above, double friction_at_floor, const SolverSettings& solver)
{
    ContactLaw above;
    ContactLaw floor;
    above.friction = friction_above;
    floor.friction = friction_at_floor;
    World world = make_world(above, floor, solver, automatic_step());
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < n; ++k)
        world.add_sphere(base_circle(n) * base_direction(n, k) + standard_radius * Vec3::UnitZ());
    world.add_sphere((2.0 * standard_radius * std::cos(upper_angle(n)) + standard_radius) * Vec3::UnitZ());
    return world;
}

} // namespace talus::test
