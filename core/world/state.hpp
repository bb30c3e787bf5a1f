// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"
#include "core/world/piston.hpp"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace talus
{

/// What a sweep reads and writes of one sphere: one cache line of 64 B.
///
/// The rotation is kept as a = r ω [m/s], for then neither radius nor inertia stands in the contact kernel of solid
/// spheres: an impulse p at the contact changes a by −5/2 p_n×t / m whatever the radius.
struct alignas(64) Motion {
    Vec3 velocity = Vec3::Zero();     ///< of the centre [m/s]
    double inverse_mass = 0.0;        ///< 1/m [1/kg]
    Vec3 rim_velocity = Vec3::Zero(); ///< a = r ω [m/s]
    double radius = 0.0;              ///< r [m]

    void persist(Archive& archive) { archive(velocity, inverse_mass, rim_velocity, radius); }
};
static_assert(sizeof(Motion) == 64 && std::is_standard_layout_v<Motion> && offsetof(Motion, velocity) == 0 &&
              offsetof(Motion, inverse_mass) == 24 && offsetof(Motion, rim_velocity) == 32 &&
              offsetof(Motion, radius) == 56); // kernels read it as eight numbers

/// Inverse moment of inertia of a solid sphere times m r²: I = 2/5 m r².
inline constexpr double inverse_inertia_factor = 2.5;

/// What exists and changes: the spheres, by storage index, the pistons, and the time. Storage order changes (spheres
/// leave, are renumbered along a curve); `id` never does.
struct State {
    std::vector<Vec3> position;          ///< x, centres [m]
    std::vector<Vec3> position_rest;     ///< what rounding has kept from x so far, far less than its last digit [m]
    std::vector<Motion> motion;          ///< v, a, 1/m, r
    std::vector<std::int32_t> material;  ///< index into Model::materials
    std::vector<std::int64_t> id;        ///< what the user sees: 0, 1, … in order of insertion
    std::vector<std::int32_t> last_wall; ///< index of the wall touched last, −1 for none
    std::vector<std::uint8_t> leaving;   ///< 1 once the centre has been inside an outlet
    std::vector<Vec3> own_force;         ///< that acts besides gravity and contacts [N]; empty: none on any

    std::vector<PistonState> pistons; ///< in the order of Model::pistons

    double time = 0.0;          ///< [s]
    std::int64_t steps = 0;     ///< taken so far
    std::int64_t next_id = 0;   ///< of the next sphere inserted: so many have been inserted so far …
    double inserted_mass = 0.0; ///< … with this mass in all [kg]

    std::size_t count() const { return position.size(); }
    double radius(std::size_t i) const { return motion[i].radius; }
    double mass(std::size_t i) const { return 1.0 / motion[i].inverse_mass; }
    Vec3 angular_velocity(std::size_t i) const { return motion[i].rim_velocity / motion[i].radius; }

    void persist(Archive& archive)
    {
        archive(position, position_rest, motion, material, id, last_wall, leaving, own_force, pistons, time, steps,
            next_id, inserted_mass);
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
