// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/motion.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr std::size_t few_spheres = 1000; ///< that one thread takes faster than several

} // namespace

void add_forces(State& state, const Vec3& gravity, double h)
{
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i) state.body(i).velocity += h * gravity;
    for (std::size_t i = 0; i < state.own_force.size(); ++i)
        state.body(i).velocity += h * state.body(i).inverse_mass * state.own_force[i];
}

void move_spheres(State& state, double h)
{
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i) {
        Vec3& x = state.position[i];
        Vec3& rest = state.position_rest[i];
        const Vec3 move = h * state.body(i).velocity + rest;
        const Vec3 before = x;
        x += move;
        rest = move - (x - before);
    }
}

double move_pistons(State& state, const std::vector<Piston>& pistons, double h)
{
    double work = 0.0;
    for (std::size_t k = 0; k < pistons.size(); ++k) {
        work += h * pistons[k].load_at(state.time) * travel_speed(pistons[k], state.pistons[k]);
        move(pistons[k], state.pistons[k], h);
    }
    return work;
}

void wrap_positions(State& state, const Periodicity& periodicity)
{
    if (!periodicity.any()) return;
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i) state.position[i] = periodicity.wrapped(state.position[i]);
}

void mark_leaving(State& state, const std::vector<Region>& outlets)
{
    for (const auto& outlet : outlets)
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
        for (std::size_t i = 0; i < state.count(); ++i)
            if (outlet.contains(state.position[i])) state.leaving[i] = 1;
}

double farthest_throw(const State& state, const std::vector<Vec3>& free_velocity)
{
    double square = 0.0;
#pragma omp parallel for schedule(static) reduction(max : square) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.bodies.size(); ++i)
        square = std::max(square, (state.bodies[i].velocity - free_velocity[i]).squaredNorm());
    return std::sqrt(square);
}

} // namespace talus
