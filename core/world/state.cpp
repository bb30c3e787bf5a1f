// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/state.hpp"

#include <numbers>

namespace talus
{
namespace
{

template <class T>
void renumber(std::vector<T>& values, const std::vector<std::int32_t>& new_index, std::size_t new_count)
{
    std::vector<T> result(new_count);
    for (std::size_t i = 0; i < new_index.size(); ++i)
        if (new_index[i] >= 0) result[static_cast<std::size_t>(new_index[i])] = values[i];
    values = std::move(result);
}

} // namespace

std::size_t add_sphere(State& state, const Vec3& position, double radius, double density, int material,
    const Vec3& velocity, const Vec3& angular_velocity)
{
    const double mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    state.inserted_mass += mass;
    state.position.push_back(position);
    state.position_rest.push_back(Vec3::Zero());
    state.radius.push_back(radius);
    state.material.push_back(material);
    state.id.push_back(state.next_id++);
    state.last_wall.push_back(-1);
    state.leaving.push_back(0);
    state.bodies.push_back({velocity, 1.0 / mass, radius * angular_velocity, radius});
    if (!state.own_force.empty()) state.own_force.push_back(Vec3::Zero());
    return state.count() - 1;
}

void renumber_spheres(State& state, const std::vector<std::int32_t>& new_index, std::size_t new_count)
{
    renumber(state.position, new_index, new_count);
    renumber(state.position_rest, new_index, new_count);
    renumber(state.radius, new_index, new_count);
    renumber(state.material, new_index, new_count);
    renumber(state.id, new_index, new_count);
    renumber(state.last_wall, new_index, new_count);
    renumber(state.leaving, new_index, new_count);
    renumber(state.bodies, new_index, new_count); // as long as each is one sphere
    if (!state.own_force.empty()) renumber(state.own_force, new_index, new_count);
}

} // namespace talus
