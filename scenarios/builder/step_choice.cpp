// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/step_choice.hpp"

#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr double gravity_share = 0.0072; ///< h / √(d/g); 0.003 is fine, above 0.016 only if the scene insists
constexpr double longest_move = 0.1;     ///< diameters in a step
constexpr double beyond_sense = 10.0;    ///< times as fast as anything should come to be
constexpr double level = 0.99;           ///< cosine of the steepest plane on which spheres come to rest for sure

/// The lowest point of the world, which may be open upwards.
double lowest_corner(const Box& world, const Vec3& up)
{
    double height = 0.0;
    for (int d = 0; d < 3; ++d)
        if (up[d] != 0.0) height += up[d] * (up[d] > 0.0 ? world.min[d] : world.max[d]);
    return height;
}

/// How far a sphere can fall: along gravity through everything that bounds the scene.
double fall_height(const Simulation& simulation)
{
    const auto& model = simulation.model;
    if (model.gravity.isZero()) return 0.0;
    const Vec3 up = model.up();
    double highest = -infinity, lowest = infinity;
    const auto span = [&](const Box& box) {
        const double middle = box.center().dot(up), half = 0.5 * box.extent().dot(up.cwiseAbs());
        lowest = std::min(lowest, middle - half);
        return middle + half;
    };
    for (const auto& pour : simulation.pours) highest = std::max(highest, span(pour.region.bounds()));
    Box spheres;
    for (std::size_t i = 0; i < simulation.state.count(); ++i)
        spheres.extend(
            Box{simulation.state.position[i], simulation.state.position[i]}.grown(simulation.state.radius[i]));
    if (!spheres.empty()) highest = std::max(highest, span(spheres));
    bool floor = !model.outlets.empty(), slope = false;
    for (const auto& wall : model.walls) {
        const auto* plane = std::get_if<Plane>(&wall.shape);
        if (!plane) {
            // Where it stands at the start: what falls behind one that sinks meets it at twice its own speed at most.
            span(bounds(wall.shape));
            floor = true;
        } else if (plane->normal.dot(up) > level) {
            lowest = std::min(lowest, plane->point.dot(up));
            floor = true;
        } else {
            slope = slope || plane->normal.dot(up) > 0.0;
        }
    }
    // Nothing is there to land on, or it leads on downwards: the fall ends where the world does.
    if (!floor || slope) lowest = std::min(lowest, lowest_corner(model.world, up));
    // A sphere is free to fall until it enters an outlet, from above.
    for (const auto& outlet : model.outlets) {
        const Box box = outlet.bounds();
        lowest = std::min(lowest, box.center().dot(up) + 0.5 * box.extent().dot(up.cwiseAbs()));
    }
    return std::max(0.0, highest - lowest);
}

/// The fastest that a part of a motion ever moves a point of the box [m/s].
double top_speed(const Translation& part, const Box&)
{
    return part.velocity.norm();
}

double top_speed(const Turning& part, const Box& box)
{
    double arm = 0.0;
    for (const Vec3& x : box.corners()) arm = std::max(arm, part.axis.cross(x - part.point).norm());
    return std::abs(part.rate) * arm;
}

double top_speed(const Shaking& part, const Box&)
{
    return 2.0 * std::numbers::pi * part.frequency * part.amplitude.norm();
}

double top_speed(const Course& part, const Box&)
{
    double fastest = 0.0;
    for (std::size_t k = 1; k < part.waypoints.size(); ++k) {
        const auto &from = part.waypoints[k - 1], &to = part.waypoints[k];
        fastest = std::max(fastest, (to.shift - from.shift).norm() / (to.time - from.time));
    }
    return fastest;
}

/// The most that any part of a wall's motion ever does, as far as the wall lies where spheres may be [m/s]. Parts that
/// go on at the same time are not added up: a step in which something is faster than this is split.
double fastest_wall(const Simulation& simulation)
{
    Box spheres;
    for (const Vec3& x : simulation.state.position) spheres.extend(x);
    for (const auto& pour : simulation.pours) spheres.extend(pour.region.bounds());
    double fastest = 0.0;
    for (const auto& wall : simulation.model.walls) {
        // A plane is looked at where the spheres are, any other wall at the corners of its box.
        const Box own = bounds(wall.shape);
        const Box& box = own.empty() ? spheres : own;
        if (box.empty()) continue;
        for (const auto& part : wall.motion)
            fastest = std::max(fastest, std::visit([&](const auto& p) { return top_speed(p, box); }, part));
    }
    return fastest;
}

/// What a piston would have if all it weighs and bears drove it across the whole scene [m/s].
double fastest_piston(const Simulation& simulation)
{
    const Model& model = simulation.model;
    Box scene;
    for (const Wall& wall : model.walls) scene.extend(bounds(wall.shape));
    for (const Vec3& x : simulation.state.position) scene.extend(x);
    double fastest = 0.0;
    for (const Piston& piston : model.pistons) {
        double load = 0.0;
        for (const LoadPoint& point : piston.load) load = std::max(load, std::abs(point.force));
        const double gain = std::abs(piston.guide.dot(model.gravity)) + load / piston.mass;
        fastest = std::max(fastest, std::sqrt(2.0 * gain * scene.extent().dot(piston.guide.cwiseAbs())));
    }
    return fastest;
}

double fastest_speed(const Simulation& simulation)
{
    double start = 0.0;
    for (const auto& m : simulation.state.bodies) start = std::max({start, m.velocity.norm(), m.rim_velocity.norm()});
    for (const auto& pour : simulation.pours) start = std::max(start, pour.velocity.norm());
    const double fall_gravity = std::abs(simulation.model.gravity.dot(simulation.model.up()));
    return std::sqrt(start * start + 2.0 * fall_gravity * fall_height(simulation)) + fastest_wall(simulation);
}

} // namespace

StepChoice choose_step(const scene::Scene& scene, const Simulation& simulation, double factor)
{
    const auto& model = simulation.model;
    StepChoice choice;
    const double fastest = fastest_speed(simulation), piston = fastest_piston(simulation);
    // With gravity pistons are too fast for its step for moments only, in which steps are split; without, one may be
    // all that moves.
    choice.fastest_speed = model.gravity.isZero() ? fastest + piston : fastest;
    choice.gravity_share = factor * gravity_share;
    choice.by_gravity = choice.gravity_share * std::sqrt(model.min_diameter / model.gravity.norm());
    choice.by_speed = longest_move * model.min_diameter / choice.fastest_speed;
    choice.given = scene.time.step.name != "auto";
    choice.step = choice.given ? scene.time.step.number : choice.automatic();
    if (!std::isfinite(choice.step))
        throw SceneError("time.step", "without gravity and speeds there is no automatic step: give one in seconds");
    if (scene.time.duration > 0.0 && choice.step > scene.time.duration)
        throw SceneError("time.step", "the step is longer than the run, 'duration'");
    choice.speed_limit = beyond_sense * (fastest + piston) + model.min_diameter / choice.step;
    return choice;
}

} // namespace talus
