// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/step_choice.hpp"

#include "core/contacts/law.hpp"
#include "scenarios/build/piston_speed.hpp"
#include "scenarios/build/wall_speed.hpp"
#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace talus
{
namespace
{

constexpr double gravity_share = 0.008; ///< h / √(d/g); 0.003 is fine, above 0.016 only if the scene insists
constexpr double longest_move = 0.1;    ///< diameters in a step
constexpr double level = 0.99;          ///< cosine of the steepest plane on which spheres come to rest for sure

template <class... Numbers> std::string text(const char* format, Numbers... numbers)
{
    char buffer[300];
    std::snprintf(buffer, sizeof buffer, format, numbers...);
    return buffer;
}

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
            Box{simulation.state.position[i], simulation.state.position[i]}.grown(simulation.state.radius(i)));
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

double fastest_speed(const Simulation& simulation)
{
    double start = 0.0;
    for (const auto& m : simulation.state.motion) start = std::max({start, m.velocity.norm(), m.rim_velocity.norm()});
    for (const auto& pour : simulation.pours) start = std::max(start, pour.velocity.norm());
    const double fall_gravity = std::abs(simulation.model.gravity.dot(simulation.model.up()));
    return std::sqrt(start * start + 2.0 * fall_gravity * fall_height(simulation)) + fastest_wall(simulation) +
           fastest_piston(simulation);
}

/// The materials that spheres are made of, now or later.
std::set<int> sphere_materials(const Simulation& simulation)
{
    std::set<int> materials(simulation.state.material.begin(), simulation.state.material.end());
    for (const auto& pour : simulation.pours)
        for (const auto& species : pour.mixture.species) materials.insert(species.material);
    return materials;
}

} // namespace

StepChoice choose_step(const scene::Scene& scene, const Simulation& simulation, double factor)
{
    const auto& model = simulation.model;
    StepChoice choice;
    choice.fastest_speed = fastest_speed(simulation);
    const double share = factor * gravity_share;
    const double from_gravity = share * std::sqrt(model.min_diameter / model.gravity.norm());
    const double from_speed = longest_move * model.min_diameter / choice.fastest_speed;
    const double automatic = std::min(from_gravity, from_speed);
    if (scene.time.step.name != "auto") {
        choice.step = scene.time.step.number;
        choice.explanation =
            text("step %.4g ms: given by the scene (auto would be %.4g ms)", 1e3 * choice.step, 1e3 * automatic);
        return choice;
    }
    if (!std::isfinite(automatic))
        throw SceneError("time.step", "without gravity and speeds there is no automatic step: give one in seconds");
    choice.step = automatic;
    choice.explanation =
        from_gravity <= from_speed
            ? text("step %.4g ms = %.3g sqrt(d/g) for the smallest d = %.4g mm (the fastest fall, %.3g m/s, moves "
                   "%.2g d in it)",
                  1e3 * automatic, share, 1e3 * model.min_diameter, choice.fastest_speed,
                  choice.fastest_speed * automatic / model.min_diameter)
            : text("step %.4g ms: the fastest sphere, %.3g m/s, moves 0.1 d in it (%.3g sqrt(d/g) would be %.4g ms)",
                  1e3 * automatic, choice.fastest_speed, share, 1e3 * from_gravity);
    return choice;
}

std::string forecast_overlap(const Simulation& simulation)
{
    const auto& model = simulation.model;
    if (model.solver.stabilisation == Stabilisation::projected)
        return "contacts are rigid; spheres that overlap are moved apart after each step";
    const double h = model.time_step, d = model.mean_diameter;
    const auto n = model.solver.min_sweeps;
    double density = 0.0, stiffness = infinity;
    for (const int a : sphere_materials(simulation)) {
        density = std::max(density, model.materials.list[static_cast<std::size_t>(a)].density);
        for (const int b : sphere_materials(simulation))
            stiffness = std::min(stiffness, model.materials.between(a, b).stiffness);
    }
    const double inverse_mass_sum = 2.0 / (density * std::numbers::pi / 6.0 * d * d * d);
    stiffness = std::min(stiffness, 4.0 * upsilon / (sigma_per_sweep / n * inverse_mass_sum * h * h));
    const double of_layer = 0.4 * model.gravity.norm() * h * h / (n * d);
    return text("contacts of two spheres are at most %.3g N/m stiff; a bed Z diameters high overlaps by %.2g Z d on "
                "average, twice that at its bottom",
        stiffness, of_layer);
}

} // namespace talus
