// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/step/diagnostics.hpp"
#include "core/step/time_step.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace talus::test
{

inline constexpr double standard_gravity = 9.81; // m/s²
inline constexpr double standard_radius = 0.005; // m
inline constexpr double standard_density = 2500; // kg/m³

/// A contact of the last step as a law speaks of it: forces in N on `a`, gap in m at the beginning of the step.
struct ContactForce {
    std::int64_t a = -1;    ///< id of a sphere
    std::int64_t b = -1;    ///< id of a sphere, or index of a wall
    bool with_wall = false; ///< b is a wall
    Vec3 normal;            ///< from b to a
    double normal_force = 0.0;
    Vec3 tangent_force;
    double friction = 0.0;
    double gap = 0.0;
    double arm_scale = 1.0;
};

/// A small simulation: what it models, its spheres (by id, because storage order may change), and how its last step
/// went.
///
/// Spheres are of material 0, walls of material 1.
struct World {
    Model model;
    State state;
    ContactNetwork network;
    StepReport report;

    /// @return the id of the new sphere
    std::int64_t add_sphere(const Vec3& position, const Vec3& velocity = Vec3::Zero(),
        const Vec3& angular_velocity = Vec3::Zero(), double radius = standard_radius,
        double density = standard_density);
    void add_wall(Shape shape, WallMotion motion = {});
    /// All attract each other so.
    void attract(const Attraction& law);
    /// A wall of finite mass, of even density in the box round it; returns its index among the pistons.
    std::size_t add_piston(Shape shape, double mass, const Vec3& guide, std::vector<LoadPoint> load = {});
    void add_plane(const Vec3& point, const Vec3& normal) { add_wall(Plane{point, normal}); }
    void step(int count = 1); ///< @throws std::runtime_error where a sphere's motion is not a number

    // The first phases of a step:
    std::vector<PlacedWall> placed_walls() const;
    std::size_t update_candidates();

    std::size_t index_of(std::int64_t id) const;
    Vec3 position(std::int64_t id = 0) const { return state.position[index_of(id)]; }
    Vec3 velocity(std::int64_t id = 0) const { return state.body(index_of(id)).velocity; }
    Vec3 angular_velocity(std::int64_t id = 0) const { return state.angular_velocity(index_of(id)); }
    double mass(std::int64_t id = 0) const { return state.mass(index_of(id)); }
    double radius(std::int64_t id = 0) const { return state.radius[index_of(id)]; }

    /// Σ m v, pistons included [kg m/s].
    Vec3 momentum() const;

    /// Contacts of the last step.
    std::vector<ContactForce> contact_forces() const;
};

/// Rigid contacts (`projected`), swept until the relative change of a sweep is below the tolerance.
SolverSettings rigid_settings(double tolerance = 1e-13, int max_sweeps = 20000);

/// The default law, `matched`, swept as far: its contacts are as soft as N_min = 2 sweeps can carry.
SolverSettings matched_settings(double tolerance = 1e-13, int max_sweeps = 20000);

/// What a run of this law gets that asks for nothing.
SolverSettings production_settings(Stabilisation stabilisation);

/// As a scene names the law.
std::string name_of(Stabilisation stabilisation);

/// h = 0.0072 √(d/g), what a scene gets whose smallest spheres have this diameter.
double automatic_step(double diameter = 2 * standard_radius);

/// 0.1 √(d g), what a scene gets whose spheres have this mean diameter [m/s].
double automatic_push_out_speed(double diameter = 2 * standard_radius);

/// An empty world with downward gravity in which spheres meet by one law and walls by the same or another.
World make_world(const ContactLaw& law, const SolverSettings& solver, double time_step);
World make_world(
    const ContactLaw& between_spheres, const ContactLaw& at_walls, const SolverSettings& solver, double time_step);

/// An empty world like that of a scene that asks for nothing and has spheres of the standard size.
World production_world(const ContactLaw& between_spheres, const ContactLaw& at_walls,
    Stabilisation stabilisation = Stabilisation::matched);
World production_world(const ContactLaw& law = {}, Stabilisation stabilisation = Stabilisation::matched);

/// A sphere (id 0) that touches the floor z = 0 without overlap.
World sphere_on_plane(const ContactLaw& law, const SolverSettings& solver, double time_step,
    const Vec3& velocity = Vec3::Zero(), const Vec3& angular_velocity = Vec3::Zero(), double radius = standard_radius);

/// Steps until the condition holds and returns how many steps that took. @throws std::runtime_error after max_steps
int advance_until(World& world, const std::function<bool(const World&)>& condition, int max_steps);

/// Velocity of the sphere's lowest point on a floor with this normal: zero when it rolls [m/s].
Vec3 slip(const World& world, std::int64_t id = 0, const Vec3& normal = Vec3::UnitZ());

/// Equal to `value` but for this relative error.
inline Approx within(double relative_error, double value)
{
    return Approx(value).epsilon(relative_error).margin(0.0);
}

} // namespace talus::test
