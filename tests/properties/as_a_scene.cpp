// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/as_a_scene.hpp"

#include "scenarios/builder/solver.hpp"
#include "scenarios/builder/step_choice.hpp"

namespace talus::test
{
namespace
{

constexpr double highest_fall = 0.2; ///< below the origin, where there is nothing to land on [m]

} // namespace

void set_as_a_scene(World& world, Stabilisation law)
{
    scene::Scene scene;
    scene.solver.stabilisation = name_of(law);
    Simulation simulation;
    simulation.model = world.model;
    simulation.state = world.state;
    simulation.model.world = {Vec3::Constant(-highest_fall), Vec3::Constant(highest_fall)};
    const SolverChoice choice = complete_solver(build_solver(scene.solver, {}), scene, simulation);
    Model& model = world.model;
    model.solver = choice.settings;
    model.time_step = choose_step(scene, simulation, choice.step_factor).step;
    model.solver.push_out_speed = push_out_speed(scene.solver, model);
}

World empty_world(const ContactLaw& law, bool gravity)
{
    World world = make_world(law, {}, 0.0);
    if (!gravity) world.model.gravity.setZero();
    return world;
}

} // namespace talus::test
