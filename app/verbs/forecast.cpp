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

constexpr double falling_share = 0.25; ///< of what a sphere takes in a bed, while it touches nothing (measured)
constexpr double around_steps = 2.0;   ///< frames, reports, and what real flows take more (measured)
constexpr double loosely_packed = 0.55; ///< of its room, what the bed that is measured fills
constexpr double loosely = 0.3;        ///< of its region, what a pour can fill at a time
constexpr int settling = 40, timed = 60;
constexpr double fewest = 100.0;  ///< spheres of the bed that is measured
constexpr double narrowest = 5.0; ///< its width in diameters, at least

/// What is measured at most. The sweeps of a soft bed hardly grow with its depth, those of a rigid one do.
struct Sample {
    double spheres, depth; ///< depth in diameters

    explicit Sample(bool deep) : spheres(deep ? 6000.0 : 1500.0), depth(deep ? 200.0 : 12.0) {}
};

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

/// A flow of so many of the scene's spheres down a slope, periodic to all sides; where pressures are scaled, which
/// periodic axes do not allow, a bed in a box.
Simulation small_flow(const OpenedScene& opened, double count, double depth)
{
    const scene::Scene& of = opened.scene;
    const Model& model = opened.simulation.model;
    const bool boxed = model.solver.pressure_scaling;
    const double d = model.mean_diameter, room = count * volume_of_sphere(d) / loosely_packed;
    const double layers = std::clamp(depth, 2.0, Sample(boxed).depth);
    const double width = std::max(narrowest * d, std::sqrt(room / (layers * d)));
    const double height = room / (width * width) + d;
    scene::Scene small;
    small.solver = of.solver;
    small.solver.stabilisation = model.solver.stabilisation == Stabilisation::matched ? "matched" : "projected";
    small.solver.min_sweeps = model.solver.min_sweeps;
    small.solver.pressure_scaling = {boxed, ""};
    small.solver.tolerance = {model.solver.tolerance, ""};
    small.time.step = {model.time_step, ""};
    small.time.duration = 0.0;
    if (!boxed) {
        small.world.periodic = {"x", "y"};
        small.world.min = Vec3(0, 0, -infinity);
        small.world.max = Vec3(width, width, infinity);
    }
    small.world.rotation = of.world.rotation;
    const double g = gravity_of(model);
    small.world.gravity = boxed ? Vec3(0, 0, -g) : Vec3(0.4 * g, 0, -0.9 * g);
    small.materials = of.materials;
    small.contact = of.contact;
    const auto& used = of.materials[static_cast<std::size_t>(*sphere_materials(opened.simulation).begin())].name;
    complete_laws(small, used);
    auto& fill = small.fill.emplace_back();
    fill.material = used;
    fill.arrangement = boxed ? "lattice" : "dense";
    fill.spacing = 1.0;
    fill.count = static_cast<std::int64_t>(count);
    fill.diameter.value = d;
    fill.region.min = Vec3(0, 0, boxed ? 0.0 : d);
    fill.region.max = Vec3(width, width, boxed ? 2.0 * height : d + height);
    auto& floor = small.wall.emplace_back();
    floor.name = "floor";
    floor.shape = boxed ? "box" : "plane";
    floor.material = used;
    floor.max = Vec3(width, width, 3.0 * height);
    if (boxed) floor.open = {"z+"};
    return build_scene(small).simulation;
}

/// What a sphere takes in a step [s].
double sphere_step(const OpenedScene& opened, double count, double depth)
{
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const double n = std::clamp(count, fewest, Sample(opened.simulation.model.solver.pressure_scaling).spheres);
    Simulation flow = small_flow(opened, n, depth);
    for (int k = 0; k < settling; ++k) advance(flow);
    const std::clock_t begin = std::clock();
    for (int k = 0; k < timed; ++k) advance(flow);
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
