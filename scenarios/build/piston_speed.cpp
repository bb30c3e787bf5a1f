// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/piston_speed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr double densest_packing = 0.7405;
constexpr double upright = 0.99; ///< cosine of the steepest guide that counts as upright
constexpr double moment = 1e-4;  ///< between two looks at a piston on its free way [s]
constexpr int most_looks = 1000000;

/// Round all that may stop a piston: spheres, and walls that have an end.
Box obstacles(const Simulation& simulation)
{
    Box box;
    for (const Wall& wall : simulation.model.walls)
        if (const Box own = bounds(wall.shape); !own.empty() && !wall.is_piston()) box.extend(own);
    for (std::size_t i = 0; i < simulation.state.count(); ++i) {
        const Vec3& x = simulation.state.position[i];
        box.extend(Box{x, x}.grown(simulation.state.radius(i)));
    }
    return box;
}

double lower_end(const Box& box, const Vec3& up)
{
    return box.center().dot(up) - 0.5 * box.extent().dot(up.cwiseAbs());
}

/// Area of the box as seen from above.
double area_from(const Vec3& up, const Box& box)
{
    const Vec3 size = box.extent();
    return up.cwiseAbs().dot(Vec3(size.y() * size.z(), size.z() * size.x(), size.x() * size.y()));
}

double solid_volume(const State& state)
{
    double volume = 0.0;
    for (const Motion& m : state.motion) volume += 4.0 / 3.0 * std::numbers::pi * std::pow(m.radius, 3);
    return volume;
}

double free_way(const Piston& piston, const Simulation& simulation)
{
    const Model& model = simulation.model;
    const Box own = bounds(model.walls[piston.wall].shape);
    const Box box = obstacles(simulation);
    if (box.empty()) return infinity;
    const Vec3 up = model.up();
    if (std::abs(piston.guide.dot(up)) < upright || !model.outlets.empty())
        return Box(box).extend(own).extent().dot(piston.guide.cwiseAbs());
    const double bed = solid_volume(simulation.state) / (densest_packing * area_from(up, box));
    return std::max(0.0, lower_end(own, up) - lower_end(box, up) - bed);
}

/// Of the free motion along the guide until it has made its way. It does not matter when the run ends: one that goes on
/// later must have the same step.
double fastest_on(double way, const Piston& piston, const Vec3& gravity)
{
    double travel = 0.0, speed = 0.0, fastest = 0.0;
    for (int k = 0; k < most_looks && std::abs(travel) < way; ++k) {
        speed += piston.guide.dot(piston.free_gain(gravity, piston.released_at + k * moment, moment));
        travel += moment * speed;
        fastest = std::max(fastest, std::abs(speed));
    }
    return fastest;
}

} // namespace

double fastest_piston(const Simulation& simulation)
{
    double fastest = 0.0;
    for (const Piston& piston : simulation.model.pistons)
        fastest = std::max(fastest, fastest_on(free_way(piston, simulation), piston, simulation.model.gravity));
    return fastest;
}

} // namespace talus
