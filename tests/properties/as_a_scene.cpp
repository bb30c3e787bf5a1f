// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/as_a_scene.hpp"

#include "scenarios/builder/solver.hpp"
#include "scenarios/builder/step_choice.hpp"

namespace talus::test
{
namespace
{

constexpr double highest_fall = 0.2; ///< below the origin, where there is nothing to land on [m]
constexpr double slow = 45.0;        ///< times the slowest impact
constexpr StepTargets one_percent{.overlap = 0.0005, .creep = 0.0018, .approach = 0.045};

} // namespace

void set_as_a_scene(World& world, Stabilisation law, double slowest_impact)
{
    scene::Scene scene;
    scene.solver.stabilisation = name_of(law);
    Simulation simulation;
    simulation.model = world.model;
    simulation.state = world.state;
    simulation.model.world = {Vec3::Constant(-highest_fall), Vec3::Constant(highest_fall)};
    const Bed bed = measure_bed(simulation);
    simulation.model.solver = complete_solver(build_solver(scene.solver, {}), scene, simulation, bed.measures).settings;
    StepChoice choice = choose_step(scene, simulation, bed);
    Model& model = world.model;
    if (slowest_impact < slow * 3.0 * choice.step * model.gravity.norm())
        choice = choose_step(scene, simulation, bed, one_percent);
    model.solver = simulation.model.solver;
    model.solver.min_sweeps = choice.min_sweeps;
    model.time_step = choice.step;
    model.solver.push_out_speed = push_out_speed(scene.solver, model);
}

World empty_world(const ContactLaw& law, bool gravity)
{
    World world = make_world(law, {}, 0.0);
    if (!gravity) world.model.gravity.setZero();
    return world;
}

} // namespace talus::test
