// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/sub_steps.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

// Moves, in smallest diameters.
constexpr double split_from = 0.2;   ///< of the fastest, by the velocities with which a step begins
constexpr double usual_move = 0.1;   ///< in a sub-step: as in the automatic step
constexpr double longest_move = 0.4; ///< with the impulses: by 0.5 the centre of what touched a thin wall is inside it

/// Nothing comes to be so many times as fast within a step as the fastest was: a light sphere that a heavy one meets
/// twice as fast, through a lighter one between them four times.
constexpr double greatest_gain = 10.0;

constexpr int most_sub_steps = 1000; ///< 250 d in a step: further moves are beyond any sense

constexpr double shallow_share = 0.01; ///< of a diameter: what beds at rest overlap by

/// The speed to which walls may add up [m/s].
double fastest_wall(const State& state, const ContactNetwork& contacts, const Model& model)
{
    double fastest = 0.0;
    if (!model.physics.moving_walls && !model.physics.pistons) return fastest;
    Box around = contacts.listed_around;
    if (around.empty())
        for (const Vec3& x : state.position) around.extend(x);
    for (const PlacedWall& wall : place_walls(model, state, model.time_step))
        if (wall.moves() && wall.stands()) fastest = std::max(fastest, wall.fastest(around));
    return fastest;
}

/// The speed of the fastest sphere if nothing touched it [m/s].
double fastest_sphere(const State& state, const Model& model)
{
    double square = 0.0;
    for (const Motion& m : state.motion) square = std::max(square, m.velocity.squaredNorm());
    return std::sqrt(square) + model.time_step * model.gravity.norm();
}

/// Takes the report of the next sub-step into that of those before it.
void merge(StepReport& whole, StepReport next)
{
    next.sweeps += whole.sweeps;
    next.residual = std::max(next.residual, whole.residual);
    next.converged = next.converged && whole.converged;
    next.worst_overlap = std::max(next.worst_overlap, whole.worst_overlap);
    next.cone_violation = std::max(next.cone_violation, whole.cone_violation);
    next.gravity_work += whole.gravity_work;
    next.contact_energy = whole.contact_energy; // at the beginning of the step
    next.fastest_speed = std::max(next.fastest_speed, whole.fastest_speed);
    next.long_moves = std::max(next.long_moves, whole.long_moves);
    next.searched += whole.searched;
    next.wall_impulse += whole.wall_impulse;
    next.wall_work += whole.wall_work;
    next.load_work += whole.load_work;
    for (std::size_t w = 0; w < next.wall_loads.size(); ++w) {
        next.wall_loads[w].impulse += whole.wall_loads[w].impulse;
        next.wall_loads[w].torque += whole.wall_loads[w].torque;
    }
    for (const Incident& earlier : whole.incidents) {
        std::erase_if(next.incidents, [&](const Incident& incident) {
            return incident.kind == earlier.kind && incident.id == earlier.id &&
                   (!incident.of_piston() || incident.last_wall == earlier.last_wall);
        });
        next.incidents.push_back(earlier);
    }
    whole = std::move(next);
}

bool goes_on(const StepReport& report)
{
    return std::ranges::all_of(report.incidents, [](const Incident& incident) {
        return incident.kind == Incident::Kind::escaped || incident.kind == Incident::Kind::pressed;
    });
}

/// A step of this model in so many sub-steps, or more where they turn out to be too few.
StepReport make_sub_steps(int count, double wall_speed, State& state, ContactNetwork& contacts, const Model& model,
    const PhaseObserver& observer)
{
    Model finer = model;
    finer.solver.shallow_overlap = shallow_share * model.min_diameter;
    StepReport whole;
    int made = 0;
    while (made < count) {
        finer.solver.sub_steps = count;
        finer.time_step = model.time_step / count;
        const double too_fast = longest_move * model.min_diameter / finer.time_step - wall_speed;
        const double fastest = 2 * count <= most_sub_steps ? too_fast : infinity;
        auto report = advance_unless_faster(fastest, state, contacts, finer, observer);
        if (!report) {
            count *= 2;
            made *= 2;
            continue;
        }
        if (made++ > 0)
            merge(whole, std::move(*report));
        else
            whole = std::move(*report);
        if (!goes_on(whole)) break;
    }
    whole.sub_steps = count;
    state.time = static_cast<double>(++state.steps) * model.time_step;
    return whole;
}

} // namespace

StepReport make_step(State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer)
{
    const double h = model.time_step, d = model.min_diameter;
    const double wall_speed = fastest_wall(state, contacts, model);
    const double move = h * (fastest_sphere(state, model) + wall_speed);
    // also where there is no diameter yet, or no number
    if (state.count() == 0 || !(greatest_gain * move > longest_move * d))
        return advance(state, contacts, model, observer);

    if (move <= split_from * d)
        if (auto report = advance_unless_faster(longest_move * d / h - wall_speed, state, contacts, model, observer))
            return *std::move(report);
    const double count = std::clamp(std::ceil(move / (usual_move * d)), 2.0, static_cast<double>(most_sub_steps));
    return make_sub_steps(static_cast<int>(count), wall_speed, state, contacts, model, observer);
}

} // namespace talus
