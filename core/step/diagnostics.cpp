// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/diagnostics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace talus
{
namespace
{

constexpr std::size_t block = 1024; ///< spheres that are summed together: fixed, so sums do not depend on the threads

std::optional<Incident::Kind> incident_of(const State& state, const Model& model, std::size_t i, double speed)
{
    const auto& m = state.body(i);
    if (!(state.position[i].allFinite() && m.velocity.allFinite() && m.rim_velocity.allFinite()))
        return Incident::Kind::not_a_number;
    if (speed > model.speed_limit) return Incident::Kind::blow_up;
    if (!model.world.contains(state.position[i]) && !state.leaving[i]) return Incident::Kind::escaped;
    return std::nullopt;
}

/// Gravity acted for a step where the spheres were before x ← x + h v.
StateSurvey survey_block(const State& state, const Model& model, double h, std::size_t begin, std::size_t end)
{
    StateSurvey survey;
    double all_mass = 0.0;
    Vec3 moment = Vec3::Zero(); // Σ m x
    for (std::size_t i = begin; i < end; ++i) {
        const Body& body = state.body(i);
        const Vec3& x = state.position[i];
        const double mass = body.mass(), speed = body.velocity.norm();
        all_mass += mass;
        moment += mass * x;
        survey.kinetic_energy += body.kinetic_energy();
        survey.momentum.linear += mass * body.velocity;
        survey.momentum.angular += body.angular_momentum(x);
        survey.fastest_speed = std::max(survey.fastest_speed, speed);
        if (const auto kind = incident_of(state, model, i, speed))
            survey.incidents.push_back({*kind, state.id[i], x, speed, state.last_wall[i]});
    }
    const Vec3 along = model.periodicity.part_along(model.gravity); // there is no height on these axes
    survey.potential_energy = -(model.gravity - along).dot(moment);
    survey.gravity_work = h * along.dot(survey.momentum.linear);
    survey.from_gravity.linear = h * all_mass * model.gravity;
    survey.from_gravity.angular = h * (moment - h * survey.momentum.linear).cross(model.gravity);
    return survey;
}

std::optional<Incident::Kind> incident_of(const PistonState& state, const Vec3& center, const Model& model)
{
    if (!(center.allFinite() && state.velocity.allFinite() && state.spin.allFinite()))
        return Incident::Kind::not_a_number;
    if (state.velocity.norm() > model.speed_limit) return Incident::Kind::blow_up;
    if (!model.world.contains(center)) return Incident::Kind::escaped;
    return std::nullopt;
}

void survey_piston(const Piston& piston, const PistonState& state, const Model& model, StateSurvey& survey)
{
    const Vec3 center = state.pose(piston.center);
    const double speed = state.velocity.norm();
    survey.kinetic_energy += kinetic_energy(piston, state);
    survey.potential_energy -= piston.mass * model.gravity.dot(center);
    survey.fastest_speed = std::max(survey.fastest_speed, speed);
    if (const auto kind = incident_of(state, center, model))
        survey.incidents.push_back({*kind, -1, center, speed, static_cast<std::int32_t>(piston.wall)});
}

/// Adds work and momentum of the spheres' own forces in a step of length h [s] that has been made.
void survey_own_forces(StateSurvey& survey, const State& state, double h)
{
    for (std::size_t i = 0; i < state.own_force.size(); ++i) {
        const Vec3 impulse = h * state.own_force[i];
        const Vec3 way = h * state.body(i).velocity;
        survey.load_work += state.own_force[i].dot(way);
        survey.from_gravity += Momentum{impulse, (state.position[i] - way).cross(impulse)};
    }
}

} // namespace

double kinetic_energy(const State& state)
{
    double sum = 0.0;
    for (const Body& body : state.bodies) sum += body.kinetic_energy();
    return sum;
}

double potential_energy(const State& state, const Vec3& gravity)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) sum -= gravity.dot(state.position[i]) / state.body(i).inverse_mass;
    return sum;
}

double sphere_energy(const State& state, const Model& model, std::size_t i)
{
    const Body& body = state.body(i);
    const Vec3 gravity = model.gravity - model.periodicity.part_along(model.gravity);
    return body.kinetic_energy() - body.mass() * gravity.dot(state.position[i]);
}

Vec3 linear_momentum(const State& state)
{
    Vec3 sum = Vec3::Zero();
    for (const Body& body : state.bodies) sum += body.mass() * body.velocity;
    return sum;
}

Vec3 angular_momentum(const State& state)
{
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < state.count(); ++i) sum += state.body(i).angular_momentum(state.position[i]);
    return sum;
}

Momentum& Momentum::operator+=(const Momentum& other)
{
    linear += other.linear;
    angular += other.angular;
    return *this;
}

void StateSurvey::then(StateSurvey next)
{
    next.from_gravity += from_gravity;
    next.gravity_work += gravity_work;
    next.load_work += load_work;
    next.fastest_speed = std::max(next.fastest_speed, fastest_speed);
    add_incidents(incidents, std::move(next.incidents));
    next.incidents = std::move(incidents);
    *this = std::move(next);
}

StateSurvey survey_state(const State& state, const Model& model, double h)
{
    const std::size_t blocks = (state.count() + block - 1) / block;
    std::vector<StateSurvey> of_block(blocks);
#pragma omp parallel for schedule(static) if (blocks > 1)
    for (std::int64_t b = 0; b < static_cast<std::int64_t>(blocks); ++b) {
        const auto begin = static_cast<std::size_t>(b) * block;
        of_block[static_cast<std::size_t>(b)] =
            survey_block(state, model, h, begin, std::min(begin + block, state.count()));
    }
    StateSurvey all;
    for (const auto& part : of_block) {
        all.kinetic_energy += part.kinetic_energy;
        all.potential_energy += part.potential_energy;
        all.gravity_work += part.gravity_work;
        all.momentum += part.momentum;
        all.from_gravity += part.from_gravity;
        all.fastest_speed = std::max(all.fastest_speed, part.fastest_speed);
        all.incidents.insert(all.incidents.end(), part.incidents.begin(), part.incidents.end());
    }
    for (std::size_t k = 0; k < model.pistons.size(); ++k)
        survey_piston(model.pistons[k], state.pistons[k], model, all);
    survey_own_forces(all, state, h);
    return all;
}

} // namespace talus
