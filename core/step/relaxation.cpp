// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/relaxation.hpp"

#include "core/step/time_step.hpp"

namespace talus
{
namespace
{

constexpr double good_overlap = 1e-6; ///< mean diameters
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

/// At the start, and at rest; the number of the step keeps the storage order as it is.
void stop(State& state)
{
    for (Body& body : state.bodies) body.velocity = body.rim_velocity = Vec3::Zero();
    state.time = 0.0;
    state.steps = 1;
}

} // namespace

int relax_overlaps(State& state, const Model& model, double worst_overlap)
{
    const Model relaxing = relaxing_model(model);
    State moved = state;
    ContactNetwork network;
    int steps = 0;
    while (worst_overlap > good_overlap * model.mean_diameter && steps < most_steps) {
        stop(moved);
        const auto report = advance_once({relaxing.time_step}, infinity, moved, network, relaxing, {});
        worst_overlap = report->contacts.worst_overlap; // before the step, which makes it smaller
        ++steps;
    }
    state.position = moved.position;
    return steps;
}

} // namespace talus
