// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/build_scene.hpp"

#include "scenarios/build/accuracy.hpp"
#include "scenarios/build/checks.hpp"
#include "scenarios/build/materials.hpp"
#include "scenarios/build/output.hpp"
#include "scenarios/build/region.hpp"
#include "scenarios/build/scaling_choice.hpp"
#include "scenarios/build/sensors.hpp"
#include "scenarios/build/solver.hpp"
#include "scenarios/build/spheres.hpp"
#include "scenarios/build/step_choice.hpp"
#include "scenarios/build/walls.hpp"
#include "scenarios/build/world.hpp"

#include <algorithm>
#include <map>

namespace talus
{
namespace
{

/// Reports, columns and `--set` tell the tables of a list apart by their names, where they have one.
template <class Table> void refuse_shared_names(const std::vector<Table>& tables, const std::string& list)
{
    std::map<std::string, std::size_t> first;
    for (std::size_t k = 0; k < tables.size(); ++k) {
        const auto [known, is_new] = first.try_emplace(tables[k].name, k);
        if (!is_new && !tables[k].name.empty())
            throw SceneError(key_path(list, k, "name"), "two " + list + "s are called '" + tables[k].name + "'",
                key_path(list, known->second, "name"));
    }
}

void refuse_shared_names(const scene::Scene& scene)
{
    refuse_shared_names(scene.wall, "wall");
    refuse_shared_names(scene.pour, "pour");
    refuse_shared_names(scene.outlet, "outlet");
    refuse_shared_names(scene.sensor, "sensor");
}

std::vector<Region> build_outlets(const scene::Scene& scene)
{
    std::vector<Region> outlets;
    for (std::size_t k = 0; k < scene.outlet.size(); ++k)
        outlets.push_back(build_region(scene.outlet[k].region, key_path("outlet", k, "region")));
    return outlets;
}

/// The constant part of the simulation, but for the step, which the spheres decide along with it.
Model build_model(const scene::Scene& scene, const RunSetting& setting)
{
    Model model;
    model.gravity = scene.world.gravity;
    model.materials = build_materials(scene);
    model.physics = needed_physics(scene, model.materials);
    model.physics.wall_loads = needs_wall_loads(scene);
    find_diameters(model, scene);
    model.periodicity = build_periodicity(scene, model.max_diameter);
    model.walls = build_walls(scene, model.materials, model.periodicity);
    model.pistons = build_pistons(scene, model.walls, model.periodicity);
    model.outlets = build_outlets(scene);
    model.world = build_world(scene, model);
    model.corner = scene_corner(scene, model);
    model.solver = build_solver(scene, setting);
    return model;
}

std::string explain_model(const Model& model)
{
    const auto& p = model.physics;
    const bool meshes = std::any_of(
        model.walls.begin(), model.walls.end(), [](const Wall& w) { return std::holds_alternative<Mesh>(w.shape); });
    std::string models = "models contact", leaves_out;
    const auto say = [&](bool needed, const char* what) {
        auto& list = needed ? models : leaves_out;
        list += (list.empty() ? "" : ", ") + std::string(what);
    };
    say(p.friction, "friction");
    say(p.spin, "rotation");
    say(p.rolling, "rolling resistance");
    say(p.restitution, "restitution");
    say(meshes, "mesh walls");
    say(p.moving_walls, "moving walls");
    say(p.pistons, "walls of finite mass");
    say(model.periodicity.any(), "periodic axes");
    say(!model.outlets.empty(), "outlets");
    if (model.solver.stabilisation == Stabilisation::projected)
        say(model.solver.pressure_scaling, "scaling of pressures");
    return models + (leaves_out.empty() ? "" : "; leaves out " + leaves_out);
}

} // namespace

Simulation build_scene(const scene::Scene& scene)
{
    refuse_shared_names(scene);
    Simulation simulation;
    auto& model = simulation.model;
    const AccuracyChoice accuracy = choose_accuracy(scene);
    model = build_model(scene, accuracy.setting);

    simulation.state.pistons.resize(model.pistons.size());
    Random random(static_cast<std::uint64_t>(scene.seed));
    fill_spheres(simulation, scene, random);
    simulation.pours = build_pours(scene, model, random);
    simulation.sensors = build_sensors(scene, model);
    simulation.output = build_output(scene);
    simulation.incident_policy = {scene.world.on_escape == "remove", scene.solver.on_no_solution == "go_on"};
    simulation.duration = scene.time.duration;

    const auto choice = choose_step(scene, simulation, accuracy.setting.step_factor);
    model.time_step = choice.step;
    model.solver.push_out_speed = push_out_speed(scene, model);
    choose_pressure_scaling(scene, simulation);
    model.speed_limit = 10.0 * choice.fastest_speed + model.min_diameter / choice.step;
    simulation.accuracy_explanation = accuracy.explanation;
    simulation.step_explanation = choice.explanation;
    simulation.model_explanation = explain_model(model);
    simulation.overlap_forecast = forecast_overlap(simulation);
    return simulation;
}

} // namespace talus
