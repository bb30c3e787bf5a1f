// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/relaxation.hpp"

namespace talus
{
namespace
{

constexpr double good_overlap = 1e-6; ///< diameters
constexpr int most_steps = 2000;

/// The model in which spheres are moved apart and do nothing else.
Model relaxing_model(const Model& model)
{
    Model relaxing = model;
    relaxing.gravity.setZero();
    relaxing.physics = {.pistons = model.physics.pistons};
    for (Piston& piston : relaxing.pistons) piston.released_at = infinity; // they stand still
    relaxing.outlets.clear();
    relaxing.solver.stabilisation = Stabilisation::projected;
    return relaxing;
}

/// As it is at the start, but at rest; the number of the step keeps the storage order as it is.
void stop(State& state)
{
    for (Motion& motion : state.motion) motion.velocity = motion.rim_velocity = Vec3::Zero();
    state.time = 0.0;
    state.steps = 1;
}

} // namespace

Relaxation relax_overlaps(Simulation& simulation, const OverlapCheck& overlaps)
{
    Relaxation relaxation;
    const Model model = relaxing_model(simulation.model);
    State state = simulation.state;
    ContactNetwork network;
    double worst = overlaps.worst;
    while (worst > good_overlap * model.mean_diameter && relaxation.steps < most_steps) {
        stop(state);
        worst = advance(state, network, model).contacts.worst_overlap; // before the step, which makes it smaller
        ++relaxation.steps;
    }
    simulation.state.position = state.position;
    relaxation.left = check_overlaps(simulation);
    return relaxation;
}

} // namespace talus
