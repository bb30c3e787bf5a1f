// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include "core/candidates/candidate_search.hpp"
#include "core/step/time_step.hpp"

#include "tests/support/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus::test
{
namespace
{

constexpr int sphere_material = 0;
constexpr int wall_material = 1;

bool any_law(const Materials& materials, double ContactLaw::*coefficient)
{
    return std::any_of(
        materials.laws.begin(), materials.laws.end(), [=](const auto& law) { return law.*coefficient > 0; });
}

ContactForce contact_force(const Contact& contact, double h)
{
    ContactForce force;
    force.normal = contact.normal;
    force.normal_force = contact.normal_impulse() / h;
    force.tangent_force = contact.impulse / h - force.normal_force * contact.normal;
    force.friction = contact.friction;
    force.gap = contact.gap;
    force.arm_scale = contact.arm_scale;
    return force;
}

} // namespace

std::int64_t World::add_sphere(
    const Vec3& position, const Vec3& velocity, const Vec3& angular_velocity, double radius, double density)
{
    talus::add_sphere(state, position, radius, density, sphere_material, velocity, angular_velocity);
    const double diameter = 2.0 * radius;
    const auto others = static_cast<double>(state.count() - 1);
    model.mean_diameter = (model.mean_diameter * others + diameter) / (others + 1.0);
    model.min_diameter = others > 0 ? std::min(model.min_diameter, diameter) : diameter;
    model.max_diameter = std::max(model.max_diameter, diameter);
    return state.id.back();
}

void World::add_wall(Shape shape, WallMotion motion)
{
    model.physics.moving_walls = model.physics.moving_walls || !motion.empty();
    model.walls.push_back({"wall " + std::to_string(model.walls.size()), std::move(shape), wall_material, 0.0, infinity,
        std::move(motion)});
}

void World::attract(const Attraction& law)
{
    model.materials.attractions.assign(model.materials.laws.size(), law);
    model.attraction_range = law.range;
    model.physics.attraction = law.range > 0.0;
}

std::size_t World::add_piston(Shape shape, double mass, const Vec3& guide, std::vector<LoadPoint> load)
{
    const std::size_t index = model.pistons.size(), wall = model.walls.size();
    const Box box = bounds(shape);
    add_wall(std::move(shape));
    model.walls[wall].piston = static_cast<std::int32_t>(index);
    model.physics.pistons = true;
    model.pistons.push_back({.wall = wall,
        .mass = mass,
        .guide = guide.normalized(),
        .center = box.center(),
        .inertia = block_inertia(mass, box.extent()),
        .load = std::move(load)});
    state.pistons.emplace_back();
    return index;
}

Vec3 World::momentum() const
{
    Vec3 sum = linear_momentum(state);
    for (std::size_t k = 0; k < model.pistons.size(); ++k) sum += model.pistons[k].mass * state.pistons[k].velocity;
    return sum;
}

std::vector<PlacedWall> World::placed_walls() const
{
    return place_walls(model, state, model.time_step);
}

std::size_t World::update_candidates()
{
    return talus::update_candidates(network.list, network.carried, state, model, model.time_step, placed_walls());
}

void World::step(int count)
{
    for (int i = 0; i < count; ++i) {
        report = advance(state, network, model);
        // Largest errors are kept with std::max, which passes over what is not a number.
        for (const Incident& incident : report.bodies.incidents)
            if (incident.kind == Incident::Kind::not_a_number) throw std::runtime_error("not a number");
    }
}

std::size_t World::index_of(std::int64_t id) const
{
    const auto found = std::find(state.id.begin(), state.id.end(), id);
    if (found == state.id.end()) throw std::out_of_range("no sphere with id " + std::to_string(id));
    return static_cast<std::size_t>(found - state.id.begin());
}

std::vector<ContactForce> World::contact_forces() const
{
    std::vector<ContactForce> forces;
    for_each_contact(network, [&](const TileContacts& contacts, std::size_t k, bool with_wall) {
        const Contact contact = contacts.contact(k);
        ContactForce force = contact_force(contact, network.carried.impulse_step);
        force.with_wall = with_wall;
        force.a = state.id[static_cast<std::size_t>(contact.a)];
        force.b = with_wall ? contact.b : state.id[static_cast<std::size_t>(contact.b)];
        forces.push_back(force);
    });
    return forces;
}

SolverSettings rigid_settings(double tolerance, int max_sweeps)
{
    SolverSettings solver = production_settings(Stabilisation::projected);
    solver.tolerance = tolerance;
    solver.max_sweeps = max_sweeps;
    return solver;
}

SolverSettings matched_settings(double tolerance, int max_sweeps)
{
    SolverSettings solver = production_settings(Stabilisation::matched);
    solver.tolerance = tolerance;
    solver.max_sweeps = max_sweeps;
    return solver;
}

SolverSettings production_settings(Stabilisation stabilisation)
{
    SolverSettings solver;
    solver.stabilisation = stabilisation;
    solver.min_sweeps = stabilisation == Stabilisation::projected ? 3 : 2;
    return solver;
}

std::string name_of(Stabilisation stabilisation)
{
    return stabilisation == Stabilisation::matched ? "matched" : "projected";
}

double automatic_step(double diameter)
{
    return 0.0072 * std::sqrt(diameter / standard_gravity);
}

double automatic_push_out_speed(double diameter)
{
    return 0.1 * std::sqrt(diameter * standard_gravity);
}

World make_world(const ContactLaw& law, const SolverSettings& solver, double time_step)
{
    return make_world(law, law, solver, time_step);
}

World make_world(
    const ContactLaw& between_spheres, const ContactLaw& at_walls, const SolverSettings& solver, double time_step)
{
    World world;
    Model& model = world.model;
    model.gravity = -standard_gravity * Vec3::UnitZ();
    model.time_step = time_step;
    model.solver = solver;
    model.world = {Vec3::Constant(-1e6), Vec3::Constant(1e6)};
    model.materials.list = {{"sphere", standard_density}, {"wall", standard_density}};
    model.materials.laws = {between_spheres, at_walls, at_walls, at_walls};
    model.physics.twisting = any_law(model.materials, &ContactLaw::twisting_friction);
    model.physics.rolling = model.physics.twisting || any_law(model.materials, &ContactLaw::rolling_friction);
    model.physics.friction = model.physics.rolling || any_law(model.materials, &ContactLaw::friction);
    model.physics.spin = model.physics.friction;
    model.physics.restitution = any_law(model.materials, &ContactLaw::restitution);
    return world;
}

World production_world(const ContactLaw& between_spheres, const ContactLaw& at_walls, Stabilisation stabilisation)
{
    SolverSettings solver = production_settings(stabilisation);
    solver.push_out_speed = automatic_push_out_speed();
    return make_world(between_spheres, at_walls, solver, automatic_step());
}

World production_world(const ContactLaw& law, Stabilisation stabilisation)
{
    return production_world(law, law, stabilisation);
}

World sphere_on_plane(const ContactLaw& law, const SolverSettings& solver, double time_step, const Vec3& velocity,
    const Vec3& angular_velocity, double radius)
{
    World world = make_world(law, solver, time_step);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(radius * Vec3::UnitZ(), velocity, angular_velocity, radius);
    return world;
}

int advance_until(World& world, const std::function<bool(const World&)>& condition, int max_steps)
{
    for (int steps = 0; steps <= max_steps; ++steps) {
        if (condition(world)) return steps;
        world.step();
    }
    throw std::runtime_error("the condition did not come true in " + std::to_string(max_steps) + " steps");
}

Vec3 slip(const World& world, std::int64_t id, const Vec3& normal)
{
    const Vec3 velocity = world.velocity(id) - world.radius(id) * world.angular_velocity(id).cross(normal);
    return velocity - velocity.dot(normal) * normal;
}

} // namespace talus::test
