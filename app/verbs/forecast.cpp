// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/forecast.hpp"

#include "scenarios/builder/bed.hpp"
#include "scenarios/builder/build_scene.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <omp.h>

namespace talus
{
namespace
{

constexpr double falling_share = 0.25;  ///< of what a sphere takes in a bed, while it touches nothing (measured)
constexpr double around_steps = 2.0;    ///< frames, reports, and what real flows take more (measured)
constexpr double loosely_packed = 0.55; ///< of its room, what the bed that is measured fills
constexpr double loosely = 0.3;         ///< of its region, what a pour can fill at a time
constexpr int settling = 40, timed = 60;
constexpr double fewest = 100.0;  ///< spheres of the bed that is measured
constexpr double narrowest = 5.0; ///< its width in diameters, at least
// The sweeps of a soft bed hardly grow with its depth; those of a deep one, whose pressures are scaled, do.
constexpr double most = 1500.0, most_deep = 6000.0;    ///< spheres of it, at most
constexpr double deepest = 12.0, deepest_deep = 200.0; ///< its depth in diameters, at most

double gravity_of(const Model& model)
{
    return model.gravity.norm();
}

/// Spheres a second that fall through what opens when a wall is taken away: a slot where it is more than twice as long
/// as wide.
double drain_rate(const Wall& wall, const Model& model)
{
    const Vec3 size = bounds(wall.shape).extent(),
               level = size - size.dot(model.up().cwiseAbs()) * model.up().cwiseAbs();
    double widest = level.maxCoeff(), narrow = 0.0;
    for (int d = 0; d < 3; ++d)
        if (level[d] < widest) narrow = std::max(narrow, level[d]);
    if (narrow == 0.0) narrow = widest;
    const double d = model.mean_diameter, open = std::max(0.0, narrow - 1.4 * d), g = gravity_of(model);
    const double flow = widest > 2.0 * narrow ? 1.03 * std::sqrt(g) * std::pow(open, 1.5) * widest
                                              : 0.58 * std::sqrt(g) * std::pow(open, 2.5);
    return packed_share * flow / volume_of_sphere(d);
}

/// How many spheres there will be, and how many of them fall, on average over the run.
struct Crowd {
    double there = 0.0, falling = 0.0;
};

Crowd crowd_of(const Simulation& simulation, const Bed& bed)
{
    constexpr int looks = 200;
    const Model& model = simulation.model;
    const double fall = gravity_of(model) > 0.0 ? std::sqrt(2.0 * bed.landing / gravity_of(model)) : 0.0;
    const auto come_by = [&](double time) {
        double count = static_cast<double>(simulation.state.count());
        for (const Pour& pour : simulation.pours) count += poured_by(pour, time, simulation);
        return count;
    };
    Crowd mean;
    for (int k = 0; k < looks; ++k) {
        const double time = simulation.duration * (k + 0.5) / looks;
        double left = come_by(time), drained = 0.0;
        if (!model.outlets.empty())
            for (const Wall& wall : model.walls)
                if (!bounds(wall.shape).empty())
                    drained += std::max(0.0, time - wall.remove_at) * drain_rate(wall, model);
        left = std::max(0.0, left - drained);
        mean.there += left / looks;
        mean.falling += std::min(left, come_by(time) - (time > fall ? come_by(time - fall) : 0.0)) / looks;
    }
    return mean;
}

/// The law between spheres of this material, which a scene with one sphere may leave out.
void complete_laws(scene::Scene& scene, const std::string& material)
{
    const std::vector<std::string> pair = {material, material};
    if (std::ranges::any_of(scene.contact, [&](const auto& law) { return law.between == pair; })) return;
    auto law = scene.contact.empty() ? scene::ContactTable{} : scene.contact[0];
    law.between = pair;
    scene.contact.push_back(law);
}

/// How wide and how high so many spheres stand, loosely packed, at this depth in diameters at most [m].
struct Room {
    double width, height;

    Room(double count, double layers, double d)
    {
        const double volume = count * volume_of_sphere(d) / loosely_packed;
        width = std::max(narrowest * d, std::sqrt(volume / (layers * d)));
        height = volume / (width * width) + d;
    }
};

/// So many of the scene's spheres on a floor, with its step and its solver; neither has a place yet.
scene::Scene sample_of(const OpenedScene& opened, double count)
{
    const scene::Scene& of = opened.scene;
    const Model& model = opened.simulation.model;
    scene::Scene sample;
    sample.solver = of.solver;
    sample.solver.stabilisation = model.solver.stabilisation == Stabilisation::matched ? "matched" : "projected";
    sample.solver.min_sweeps = model.solver.min_sweeps;
    sample.solver.pressure_scaling = {model.solver.pressure_scaling, ""};
    sample.solver.tolerance = {model.solver.tolerance, ""};
    sample.time.step = {model.time_step, ""};
    sample.time.duration = 0.0;
    sample.world.rotation = of.world.rotation;
    sample.materials = of.materials;
    sample.contact = of.contact;
    const auto& used = of.materials[static_cast<std::size_t>(*sphere_materials(opened.simulation).begin())].name;
    complete_laws(sample, used);
    auto& fill = sample.fill.emplace_back();
    fill.material = used;
    fill.count = static_cast<std::int64_t>(count);
    fill.diameter.value = model.mean_diameter;
    auto& floor = sample.wall.emplace_back();
    floor.name = "floor";
    floor.material = used;
    return sample;
}

/// A flow down a slope, periodic to all sides.
Simulation small_flow(const OpenedScene& opened, double count, double depth)
{
    const double d = opened.simulation.model.mean_diameter, g = gravity_of(opened.simulation.model);
    const Room room(count, std::clamp(depth, 2.0, deepest), d);
    scene::Scene flow = sample_of(opened, count);
    flow.world.periodic = {"x", "y"};
    flow.world.min = Vec3(0, 0, -infinity);
    flow.world.max = Vec3(room.width, room.width, infinity);
    flow.world.gravity = Vec3(0.4 * g, 0, -0.9 * g);
    flow.fill[0].arrangement = "dense";
    flow.fill[0].region.min = Vec3(0, 0, d);
    flow.fill[0].region.max = Vec3(room.width, room.width, d + room.height);
    flow.wall[0].shape = "plane";
    return build_scene(flow).simulation;
}

/// A deep bed in a box, since pressures are not scaled along periodic axes. It stands as a lattice that touches.
Simulation small_column(const OpenedScene& opened, double count, double depth)
{
    const Model& model = opened.simulation.model;
    const Room room(count, std::clamp(depth, 2.0, deepest_deep), model.mean_diameter);
    scene::Scene column = sample_of(opened, count);
    column.world.gravity = Vec3(0, 0, -gravity_of(model));
    column.fill[0].spacing = 1.0;
    column.fill[0].region.max = Vec3(room.width, room.width, 2.0 * room.height);
    column.wall[0].shape = "box";
    column.wall[0].max = Vec3(room.width, room.width, 3.0 * room.height);
    column.wall[0].open = {"z+"};
    return build_scene(column).simulation;
}

/// What a sphere takes in a step [s].
double sphere_step(const OpenedScene& opened, double count, double depth)
{
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const bool is_deep = opened.simulation.model.solver.pressure_scaling;
    const double n = std::clamp(count, fewest, is_deep ? most_deep : most);
    Simulation bed = is_deep ? small_column(opened, n, depth) : small_flow(opened, n, depth);
    for (int k = 0; k < settling; ++k) advance(bed);
    const std::clock_t begin = std::clock();
    for (int k = 0; k < timed; ++k) advance(bed);
    const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    omp_set_num_threads(threads);
    return took / timed / n;
}

} // namespace

double poured_by(const Pour& source, double time, const Simulation& simulation)
{
    const Materials& materials = simulation.model.materials;
    const double since = std::max(0.0, time - source.start), g = gravity_of(simulation.model);
    const double of_rate = std::min(source.rate, source.mass_rate / source.mixture.mean_mass(materials)) * since;
    // What comes in must go down before more can.
    const Box box = source.region.bounds();
    const double height = box.extent().dot(simulation.model.up().cwiseAbs()), speed = source.velocity.norm();
    const double clears = g > 0.0 ? (std::sqrt(speed * speed + 2.0 * g * height) - speed) / g : height / speed;
    const double at_once = loosely * source.region.volume() / volume_of_sphere(source.mixture.mean_diameter());
    return std::min({expected_count(source, materials), since > 0.0 ? of_rate : 0.0, at_once * (1.0 + since / clears)});
}

double forecast_cpu(const OpenedScene& opened)
{
    const Simulation& simulation = opened.simulation;
    const Bed bed = measure_bed(simulation);
    const Crowd crowd = crowd_of(simulation, bed);
    const double steps = std::ceil(simulation.duration / simulation.model.time_step);
    const double busy = crowd.there - crowd.falling + falling_share * crowd.falling;
    return around_steps * steps * sphere_step(opened, crowd.there, bed.measures.depth) * busy;
}

} // namespace talus
