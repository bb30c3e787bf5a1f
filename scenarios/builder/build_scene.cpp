// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"

#include "scenarios/builder/accuracy.hpp"
#include "scenarios/builder/checks.hpp"
#include "scenarios/builder/materials.hpp"
#include "scenarios/builder/sensors.hpp"
#include "scenarios/builder/walls.hpp"
#include "scenarios/builder/world.hpp"

#include <algorithm>
#include <map>

namespace talus
{
namespace
{

/// `--set` joins names by dots.
void require_plain(const std::string& name, const std::string& key)
{
    if (name.find('.') != std::string::npos)
        throw SceneError(key, "the name '" + name + "' has a '.', with which --set could not name it");
}

/// Reports, columns and `--set` tell the tables of a list apart by their names, where they have one.
template <class Table> void check_names(const std::vector<Table>& tables, const std::string& list)
{
    std::map<std::string, std::size_t> first;
    for (std::size_t k = 0; k < tables.size(); ++k) {
        require_plain(tables[k].name, key_path(list, k, "name"));
        const auto [known, is_new] = first.try_emplace(tables[k].name, k);
        if (!is_new && !tables[k].name.empty())
            throw SceneError(key_path(list, k, "name"), "two " + list + "s are called '" + tables[k].name + "'",
                key_path(list, known->second, "name"));
    }
}

void check_names(const scene::Scene& scene)
{
    for (const auto& material : scene.materials) require_plain(material.name, "materials." + material.name);
    check_names(scene.wall, "wall");
    check_names(scene.pour, "pour");
    check_names(scene.outlet, "outlet");
    check_names(scene.sensor, "sensor");
}

OutputChoice build_output(const scene::OutputTable& table)
{
    OutputChoice choice{table.particle_arrays, table.contact_arrays, table.contact_threshold, {}};
    const bool known_later = table.region.shape == "mesh"; // what it encloses depends on the size of the spheres
    if (table.region.shape != "everything" && !known_later)
        choice.region = require_region(table.region, 0.0, "output.region");
    return choice;
}

std::vector<Region> build_outlets(const scene::Scene& scene, double diameter)
{
    std::vector<Region> outlets;
    for (std::size_t k = 0; k < scene.outlet.size(); ++k)
        outlets.push_back(require_region(scene.outlet[k].region, diameter, key_path("outlet", k, "region")));
    return outlets;
}

/// The constant part of the simulation, but for what the spheres decide when they have their places: step, speed limit
/// and solver.
Model build_model(const scene::Scene& scene, const Materials& materials, const std::vector<Fill>& fills,
    const std::vector<Pour>& pours)
{
    Model model;
    model.gravity = scene.world.gravity;
    model.materials = materials;
    find_diameters(model, fills, pours);
    add_attractions(model, scene);
    model.periodicity = build_periodicity(scene.world, model.max_diameter);
    model.walls = build_walls(scene, materials, model.periodicity, model.mean_diameter);
    model.pistons = build_pistons(scene, model.walls, model.periodicity);
    model.physics.wall_loads =
        std::ranges::any_of(scene.sensor, [](const auto& own) { return own.kind == "wall_force"; });
    model.physics = model.needed_physics(scene.world.rotation);
    if (model.physics.rolling && !scene.world.rotation)
        throw SceneError("world.rotation", "spheres that do not turn have no rolling and twisting resistance: leave "
                                           "out 'rolling_friction' and 'twisting_friction', or let them turn");
    model.outlets = build_outlets(scene, model.mean_diameter);
    model.world = build_world(scene, model, fills, pours);
    model.contents = build_contents(model, fills, pours);
    require_inside_world(fills, pours, model.world);
    return model;
}

} // namespace

BuiltScene build_scene(const scene::Scene& scene)
{
    check_names(scene);

    // Every table is read once, in the order of the scene.
    Simulation simulation;
    Model& model = simulation.model;
    const AccuracyChoice accuracy = choose_accuracy(scene);
    simulation.duration = scene.time.duration;
    const SolverSettings solver = build_solver(scene.solver, accuracy.setting);
    OutputChoice output = build_output(scene.output);
    simulation.incident_policy = {scene.world.on_escape == "remove",
        solver.stabilisation == Stabilisation::matched || scene.solver.on_no_solution == "go_on"};
    const Materials materials = build_materials(scene);
    const std::vector<Fill> fills = build_fills(scene, materials);
    simulation.pours = build_pours(scene, materials);
    model = build_model(scene, materials, fills, simulation.pours);
    simulation.sensors = build_sensors(scene, model);
    if (scene.output.region.shape == "mesh")
        output.region = require_region(scene.output.region, model.mean_diameter, "output.region");

    // Spheres take their places among the walls. One generator gives all fills theirs, and then each pour its seed.
    Random random(static_cast<std::uint64_t>(scene.seed));
    place_spheres(simulation.state, fills, model, random);
    for (Pour& pour : simulation.pours) pour.random.seed(random());
    simulation.state.pistons.resize(model.pistons.size());

    // The spheres decide what the scene leaves open of the solver and the step.
    const Bed bed = measure_bed(simulation);
    const SolverChoice choice = complete_solver(solver, scene, simulation, bed.measures);
    model.solver = choice.settings;
    const StepChoice step = choose_step(scene, simulation, bed, accuracy.setting.targets);
    model.time_step = step.step;
    model.solver.min_sweeps = step.min_sweeps;
    model.speed_limit = step.speed_limit;
    model.solver.push_out_speed = push_out_speed(scene.solver, model);

    BuildReport report{accuracy.explanation, choice.explanation, explain_step(step, model.min_diameter),
        explain_model(model), explain_world(model.world), explain_files(scene), forecast_overlap(simulation, bed),
        warnings_of(scene, step, model)};
    return {std::move(simulation), std::move(report), std::move(output)};
}

} // namespace talus
