// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"
#include "core/world/body.hpp"
#include "core/world/piston.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus
{

/// What exists and changes: spheres and the bodies that they belong to, the pistons, and the time. Storage order
/// changes (spheres leave, are renumbered along a curve); `id` never does.
struct State {
    // Spheres, by storage index: what touches.
    std::vector<Vec3> position;          ///< x, centres [m]
    std::vector<Vec3> position_rest;     ///< what rounding has kept from x so far, far less than its last digit [m]
    std::vector<double> radius;          ///< r [m]
    std::vector<std::int32_t> material;  ///< index into Model::materials
    std::vector<std::int64_t> id;        ///< what the user sees: 0, 1, … in order of insertion
    std::vector<std::int32_t> last_wall; ///< index of the wall touched last, −1 for none
    std::vector<std::uint8_t> leaving;   ///< 1 once the centre has been inside an outlet

    // Bodies, by their index: what moves.
    std::vector<Body> bodies;    ///< v, a, 1/m
    std::vector<Vec3> own_force; ///< that acts besides gravity and contacts [N]; empty: none on any

    std::vector<PistonState> pistons; ///< in the order of Model::pistons

    double time = 0.0;          ///< [s]
    std::int64_t steps = 0;     ///< taken so far
    std::int64_t next_id = 0;   ///< of the next sphere inserted: so many have been inserted so far …
    double inserted_mass = 0.0; ///< … with this mass in all [kg]

    std::size_t count() const { return position.size(); } ///< of spheres

    /// The body that a sphere belongs to, as an index. Each is a body of its own so far: the same index.
    static std::size_t body_of(std::size_t sphere) { return sphere; }
    Body& body(std::size_t sphere) { return bodies[body_of(sphere)]; }
    const Body& body(std::size_t sphere) const { return bodies[body_of(sphere)]; }

    double mass(std::size_t sphere) const { return body(sphere).mass(); }
    Vec3 angular_velocity(std::size_t sphere) const { return body(sphere).spin(); }

    void persist(Archive& archive)
    {
        archive(position, position_rest, radius, material, id, last_wall, leaving, bodies, own_force, pistons, time,
            steps, next_id, inserted_mass);
    }
};

/// Puts a solid sphere into the state and returns its storage index (the last).
/// @param density [kg/m³]; @param angular_velocity ω [rad/s]
std::size_t add_sphere(State& state, const Vec3& position, double radius, double density, int material,
    const Vec3& velocity = Vec3::Zero(), const Vec3& angular_velocity = Vec3::Zero());

/// Brings the spheres into a new storage order: sphere i goes to new_index[i], or is dropped where that is negative.
/// @pre the non-negative entries are 0 … new_count−1, each once.
void renumber_spheres(State& state, const std::vector<std::int32_t>& new_index, std::size_t new_count);

} // namespace talus
