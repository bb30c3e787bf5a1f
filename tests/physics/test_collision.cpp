// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include "core/base/region.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr int collisions = 300;
constexpr double time_step = 1e-5;

double between(Random& random, double low, double high)
{
    return low + (high - low) * uniform(random);
}

Vec3 random_vector(Random& random, double size)
{
    return size * Vec3(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
}

struct Collision {
    World world;
    Vec3 normal; ///< from sphere 1 to sphere 0 when they touch
};

/// Two spheres that approach, with spins; radii to 1 : 20, masses to 1 : 32 000, any impact parameter but the last 1 %,
/// friction 0 to 10. With restitution they touch within the step;
/// without, they overlap by up to 10 % of the smaller radius.
Collision random_collision(Random& random, double restitution, const SolverSettings& solver)
{
    ContactLaw law;
    law.friction = uniform(random) < 0.2 ? 0.0 : std::pow(10.0, between(random, -2, 1));
    law.restitution = restitution;
    World world = make_world(law, solver, time_step);
    world.model.gravity = Vec3::Zero();

    const double r1 = 0.01 * std::pow(20.0, -uniform(random));
    const double r2 = 0.01 * std::pow(20.0, -uniform(random));
    const double overlap = restitution > 0.0 ? 0.0 : 0.1 * uniform(random) * std::min(r1, r2);
    const double instant = restitution > 0.0 ? between(random, 0.0, 1.0) * time_step : 0.0;
    const Vec3 normal = random_vector(random, 1.0).normalized();
    const Vec3 position = random_vector(random, 0.1);
    Vec3 v1 = random_vector(random, 1.0);
    const Vec3 v2 = random_vector(random, 1.0);
    if ((v1 - v2).dot(normal) > 0) v1 -= 2.0 * (v1 - v2).dot(normal) * normal;
    v1 -= 0.14 * (v1 - v2).norm() * normal;
    world.add_sphere(position + (r1 + r2 - overlap) * normal - instant * v1, v1, random_vector(random, 1.0 / r1), r1,
        between(random, 500, 5000));
    world.add_sphere(position - instant * v2, v2, random_vector(random, 1.0 / r2), r2, between(random, 500, 5000));
    return {world, normal};
}

/// The normal velocity of sphere 0 relative to sphere 1, normals taken from `at`.
double normal_velocity(const World& world, const Vec3& normal)
{
    return (world.velocity(0) - world.velocity(1)).dot(normal);
}

double momentum_scale(const State& state)
{
    double scale = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i)
        scale += state.mass(i) * (state.body(i).velocity.norm() + state.body(i).rim_velocity.norm());
    return scale;
}

} // namespace

TEST_CASE("a collision keeps linear and angular momentum", "[invariance][friction][restitution]")
{
    // Impulses come in opposite pairs with lever arms that add up to the distance of the centres, overlap or not; with
    // arms r₁ and r₂ angular momentum would change by up to 28 % here. Round-off of one step of numbers of order one.
    // Without restitution impulses act at the positions of the beginning of the step: `projected` moves overlapping
    // spheres apart after it.
    Random random(1);
    const double e = GENERATE(0.0, 0.5, 1.0);
    const auto solver = GENERATE(rigid_settings(), matched_settings());
    for (int k = 0; k < collisions; ++k) {
        World world = random_collision(random, e, solver).world;
        const State before = world.state;
        world.step();
        State after = world.state;
        const double scale = momentum_scale(before);
        CHECK((linear_momentum(after) - linear_momentum(before)).norm() < 1e-14 * scale);

        const double lever = before.position[0].norm() + before.position[1].norm() + 0.02;
        if (e == 0.0 && solver.stabilisation == Stabilisation::projected)
            for (std::size_t i = 0; i < after.count(); ++i) after.position[i] = before.position[after.id[i]];
        CHECK((angular_momentum(after) - angular_momentum(before)).norm() < 1e-14 * scale * lever);
    }
}

TEST_CASE("a collision turns the normal velocity round by e and never adds energy", "[restitution][energy]")
{
    // u_n' = −e u_n for every friction, spin and mass, overlap or not. Friction takes energy, the normal part loses
    // ½ m_eff (1 − e²) u_n². Without restitution this is the rigid law: `matched` also pushes the overlap out.
    Random random(2);
    const double e = GENERATE(0.0, 0.3, 0.9, 1.0);
    const auto solver = e > 0 ? GENERATE(rigid_settings(), matched_settings()) : rigid_settings();
    for (int k = 0; k < collisions; ++k) {
        auto [world, normal] = random_collision(random, e, solver);
        const double approach = normal_velocity(world, normal);
        const double energy = kinetic_energy(world.state);
        world.step();
        CHECK(normal_velocity(world, normal) == Approx(-e * approach).margin(1e-13));
        const double effective_mass = 1.0 / (1.0 / world.mass(0) + 1.0 / world.mass(1));
        const double least_loss = 0.5 * effective_mass * (1 - e * e) * approach * approach;
        CHECK(energy - kinetic_energy(world.state) >= least_loss - 1e-13 * energy);
    }
}

TEST_CASE("a head-on collision gives the velocities of the textbook", "[restitution]")
{
    // v₁' = ((m₁ − e m₂) v₁ + (1 + e) m₂ v₂) / (m₁ + m₂); equal spheres with e = 1 swap their velocities.
    const double e = GENERATE(0.25, 1.0);
    const double ratio = GENERATE(1.0, 3.0); // of radii
    ContactLaw law;
    law.restitution = e;
    World world = make_world(law, GENERATE(rigid_settings(), matched_settings()), 1e-4);
    world.model.gravity = Vec3::Zero();
    const double v1 = 2.0;
    const double v2 = -0.5;
    world.add_sphere(Vec3(-0.02, 0, 0), Vec3(v1, 0, 0));
    world.add_sphere(Vec3(0.02, 0, 0), Vec3(v2, 0, 0), Vec3::Zero(), ratio * standard_radius);
    const double m1 = world.mass(0);
    const double m2 = world.mass(1);
    world.step(200);
    CHECK(world.velocity(0).x() == Approx(((m1 - e * m2) * v1 + (1 + e) * m2 * v2) / (m1 + m2)).margin(1e-14));
    CHECK(world.velocity(1).x() == Approx(((m2 - e * m1) * v2 + (1 + e) * m1 * v1) / (m1 + m2)).margin(1e-14));
}

TEST_CASE("a collision is the same for a moving observer", "[invariance]")
{
    Random random(3);
    const double e = GENERATE(0.0, 0.6);
    const Vec3 boost(3.0, -2.0, 5.0);
    for (int k = 0; k < 50; ++k) {
        World at_rest = random_collision(random, e, rigid_settings()).world;
        World moving = at_rest;
        for (Body& motion : moving.state.bodies) motion.velocity += boost;
        at_rest.step();
        moving.step();
        for (const int id : {0, 1}) { // 1e-10: asked; the boost costs a digit of round-off
            CHECK((moving.velocity(id) - boost - at_rest.velocity(id)).norm() < 1e-10);
            CHECK((moving.angular_velocity(id) - at_rest.angular_velocity(id)).norm() <
                  1e-10 * at_rest.angular_velocity(id).norm());
            CHECK((moving.position(id) - time_step * boost - at_rest.position(id)).norm() < 1e-10 * standard_radius);
        }
    }
}

} // namespace talus::test
