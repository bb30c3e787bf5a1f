// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

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

/// The speed to which walls may add up [m/s].
double fastest_wall(const State& state, const ContactNetwork& network, const Model& model)
{
    double fastest = 0.0;
    if (!model.physics.moving_walls && !model.physics.pistons) return fastest;
    Box around = network.list.listed_around;
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
    for (const Body& m : state.bodies) square = std::max(square, m.velocity.squaredNorm());
    return std::sqrt(square) + model.time_step * model.gravity.norm();
}

bool goes_on(const StepReport& report)
{
    return std::ranges::all_of(report.bodies.incidents, [](const Incident& incident) {
        return incident.kind == Incident::Kind::escaped || incident.kind == Incident::Kind::pressed ||
               incident.is_harmless();
    });
}

/// A step in so many sub-steps, or more where they turn out to be too few.
StepReport make_sub_steps(int count, double wall_speed, State& state, ContactNetwork& network, const Model& model,
    const PhaseObserver& observer)
{
    std::optional<StepReport> whole;
    int made = 0;
    while (made < count) {
        const StepLength step{model.time_step, count};
        const double too_fast = longest_move * model.min_diameter / step.h() - wall_speed;
        const double fastest = 2 * count <= most_sub_steps ? too_fast : infinity;
        auto report = advance_once(step, fastest, state, network, model, observer);
        if (!report) {
            count *= 2;
            made *= 2;
            continue;
        }
        ++made;
        if (whole)
            whole->then(*std::move(report));
        else
            whole = std::move(report);
        if (!goes_on(*whole)) break;
    }
    whole->sub_steps = count;
    StepLength{model.time_step}.pass(state);
    return *std::move(whole);
}

} // namespace

StepReport advance(State& state, ContactNetwork& network, const Model& model, const PhaseObserver& observer)
{
    const double h = model.time_step, d = model.min_diameter;
    const double wall_speed = fastest_wall(state, network, model);
    const double move = h * (fastest_sphere(state, model) + wall_speed);
    // also where there is no diameter yet, or no number
    if (state.count() == 0 || !(greatest_gain * move > longest_move * d))
        return *advance_once({h}, infinity, state, network, model, observer);

    if (move <= split_from * d)
        if (auto report = advance_once({h}, longest_move * d / h - wall_speed, state, network, model, observer))
            return *std::move(report);
    const double count = std::clamp(std::ceil(move / (usual_move * d)), 2.0, static_cast<double>(most_sub_steps));
    return make_sub_steps(static_cast<int>(count), wall_speed, state, network, model, observer);
}

} // namespace talus
