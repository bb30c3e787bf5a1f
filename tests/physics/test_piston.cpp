// SPDX-License-Identifier: GPL-3.0-or-later
// What a wall of finite mass does, alone and with a few spheres.
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr double r = standard_radius, h = 1e-4;
constexpr double no_drift = 1e-12;

/// A level plate with its middle there.
Disk plate(const Vec3& middle, double radius = 0.05)
{
    return {middle, Vec3::UnitZ(), radius, 0.0};
}

/// A sphere at rest on a floor, for a scene to have one.
World world_with_sphere(const SolverSettings& solver, const ContactLaw& law = {})
{
    return sphere_on_plane(law, solver, h);
}

/// How far a piston is off its guide: across it [m], and turned [rad].
struct Drift {
    double across, turn;
};

Drift drift(const World& world, std::size_t k = 0)
{
    const Piston& piston = world.model.pistons[k];
    const Pose& pose = world.state.pistons[k].pose;
    const Vec3 way = pose(piston.center) - piston.center;
    return {(way - way.dot(piston.guide) * piston.guide).norm(), Eigen::AngleAxisd(pose.rotation).angle()};
}

Vec3 floor_force(const World& world)
{
    return -world.report.outcome.from_walls.impulse / h;
}

} // namespace

TEST_CASE("a piston that touches nothing falls along its guide with the share of gravity that its guide leaves it",
    "[physics][piston]")
{
    // x(n) = ½ a h² n (n + 1) in symplectic steps, a = g·guide + F/M.
    World world = world_with_sphere(production_settings(Stabilisation::matched));
    const double mass = 0.7, force = 2.0;
    const std::size_t k = world.add_piston(plate(Vec3(1, 0, 1)), mass, Vec3(0.3, -0.4, -1), {{0.0, force}});
    constexpr int steps = 700;
    world.step(steps);
    const Piston& piston = world.model.pistons[k];
    const double a = world.model.gravity.dot(piston.guide) + force / mass;
    CHECK(travel(piston, world.state.pistons[k]) == within(1e-12, 0.5 * a * h * h * steps * (steps + 1.0)));
    CHECK(travel_speed(piston, world.state.pistons[k]) == within(1e-12, a * h * steps));
    CHECK(drift(world).across < no_drift);
    CHECK(drift(world).turn == 0.0);
}

TEST_CASE("a piston is held until its release, and what holds it carries weight and load", "[physics][piston]")
{
    World world = world_with_sphere(production_settings(Stabilisation::matched));
    world.add_piston(plate(Vec3(1, 0, 1)), 0.7, Vec3(0, 0, -1), {{0.0, 2.0}});
    world.model.pistons[0].released_at = 100.5 * h;
    world.step(101); // the last begins before the release
    const PistonState& piston = world.state.pistons[0];
    CHECK(piston.velocity.norm() < 1e-15);
    CHECK(travel(world.model.pistons[0], piston) == Approx(0.0).margin(no_drift));
    CHECK(-piston.guide_impulse[5] / h == within(1e-12, 0.7 * standard_gravity + 2.0));
    world.step();
    CHECK(piston.velocity.z() == within(1e-12, -h * (standard_gravity + 2.0 / 0.7)));
}

TEST_CASE("a load goes in straight lines from row to row and is held at the ends", "[physics][piston]")
{
    Piston piston;
    CHECK(piston.load_at(1.0) == 0.0);
    piston.load = {{1.0, 10.0}, {3.0, 50.0}, {3.5, 0.0}};
    CHECK(piston.load_at(0.0) == 10.0);
    CHECK(piston.load_at(2.0) == 30.0);
    CHECK(piston.load_at(3.0) == 50.0);
    CHECK(piston.load_at(3.25) == 25.0);
    CHECK(piston.load_at(9.0) == 0.0);
}

TEST_CASE(
    "the floor under a loaded plate on one sphere or three carries their weights and the load", "[physics][piston]")
{
    const auto solver = GENERATE(rigid_settings(1e-11), matched_settings(1e-11));
    const double mass = GENERATE(0.001, 0.1, 1.0), load = 5.0;
    const int spheres = GENERATE(1, 3);
    ContactLaw law;
    law.friction = 0.5;
    World world = make_world(law, solver, h);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    // Beside the middle of the plate, or round it at uneven distances.
    for (int k = 0; k < spheres; ++k)
        world.add_sphere(0.02 * (1.0 + 0.3 * k) * Vec3(std::cos(2.0 * k), std::sin(2.0 * k), 0.0) + Vec3(0, 0, r));
    world.add_piston(plate(Vec3(0, 0, 2.0 * r)), mass, Vec3::UnitZ(), {{0.0, -load}});
    world.step(6000);
    const double weight = (mass + spheres * world.mass()) * standard_gravity;
    CAPTURE(mass, spheres);
    CHECK(-floor_force(world).z() == within(1e-6, weight + load));
    CHECK(kinetic_energy(world.model.pistons[0], world.state.pistons[0]) < 1e-12 * mass);
    CHECK(drift(world).across < no_drift);
    CHECK(drift(world).turn < no_drift);
}

TEST_CASE("a plate pushed beside its centre does not turn: its guide takes the torque", "[physics][piston]")
{
    World world = world_with_sphere(matched_settings());
    const double mass = 0.2, arm = 0.03;
    world.add_piston(plate(Vec3(-arm, 0, 2.0 * r)), mass, Vec3::UnitZ());
    world.step(3000);
    const double weight = mass * standard_gravity;
    // The sphere pushes up at (arm, 0, 0) from the centre: a torque of −arm × weight about y, and the guide's against
    // it.
    CHECK(world.state.pistons[0].guide_impulse[3] / h == within(1e-6, arm * weight));
    CHECK(drift(world).turn < no_drift);
    CHECK(drift(world).across < no_drift);
}

TEST_CASE("a plate turns as little when a step stops at its first sweeps", "[physics][piston]")
{
    World world = world_with_sphere(production_settings(Stabilisation::matched));
    world.model.solver.max_sweeps = 2;
    world.add_piston(plate(Vec3(-0.03, 0.01, 3.0 * r)), 0.01, Vec3::UnitZ());
    world.step(500);
    CHECK(drift(world).turn < no_drift);
    CHECK(drift(world).across < no_drift);
}

TEST_CASE("a plate brought off its guide comes back to it", "[physics][piston]")
{
    // As any error of a holonomic row in the note's step at critical damping: g₀ (1 + 2k/3) 3⁻ᵏ.
    World world = world_with_sphere(production_settings(Stabilisation::matched));
    world.add_piston(plate(Vec3(1, 0, 1)), 0.2, Vec3::UnitZ());
    world.state.pistons[0].pose.shift = Vec3(1e-4, 0, 0);
    for (int k = 1; k <= 5; ++k) {
        world.step();
        CHECK(world.state.pistons[0].pose.shift.x() == within(1e-9, 1e-4 * (1.0 + 2.0 * k / 3.0) * std::pow(3.0, -k)));
    }
}

TEST_CASE("a falling plate and a sphere part with e times the speed at which they met, and keep their momentum",
    "[physics][piston]")
{
    // Off the centre: the guide makes the plate's mass at the contact that of all of it, 1/W = 1/(1/m + 1/M).
    const double e = GENERATE(0.0, 0.6, 1.0), mass = GENERATE(0.0005, 0.01, 1.0);
    ContactLaw law;
    law.restitution = e;
    law.friction = 0.5;
    World world = make_world(law, rigid_settings(), h);
    world.model.gravity.setZero();
    world.model.solver.restitution_threshold = 0.0;
    world.add_sphere(Vec3::Zero());
    world.add_piston(plate(Vec3(0.02, 0.01, r + 0.5e-4)), mass, Vec3::UnitZ());
    const double speed = 0.8;
    world.state.pistons[0].velocity = Vec3(0, 0, -speed);
    world.step(3);
    const double m = world.mass();
    const double common = -speed * mass / (m + mass);
    CAPTURE(e, mass);
    CHECK(world.velocity().z() == within(1e-9, common * (1.0 + e)));
    CHECK(world.state.pistons[0].velocity.z() == Approx(common + e * speed * m / (m + mass)).margin(1e-9 * speed));
    CHECK(world.momentum().z() == within(1e-10, -mass * speed));
    CHECK(world.velocity().head<2>().norm() < 1e-10 * speed);
}

TEST_CASE("a plate that its load sets going stops at a sphere a step later where another strikes this one meanwhile",
    "[physics][piston]")
{
    // The load closes four times the gap. What has no load beside an impact is deferred: the plate goes on in this
    // step, and stops at the sphere in the next one. Momentum along z is what the load gave.
    ContactLaw law;
    law.restitution = 0.5;
    law.friction = 0.0;
    World world = make_world(law, rigid_settings(), h);
    world.model.gravity.setZero();
    const double mass = 0.05, gain = 0.4 * h; // of the plate in the step [m/s]
    const double gap = 0.25 * gain * h;
    world.add_sphere(Vec3::Zero());
    world.add_sphere(Vec3(2.0 * r + 1e-5, 0, 0), Vec3(-0.5, 0, 0));
    world.add_piston(plate(Vec3(0, 0, r + gap), 0.5 * r), mass, Vec3::UnitZ(), {{0.0, -mass * gain / h}});
    world.step();
    const double m = world.mass(), sphere = world.velocity().z(), piston = world.state.pistons[0].velocity.z();
    CHECK(world.velocity().x() == Approx(-0.5 * (1.0 + law.restitution) * 0.5));
    CHECK(piston - sphere == within(1e-6, -gain));
    CHECK(mass * piston + m * sphere == within(1e-9, -mass * gain));
    world.step();
    const double then = world.velocity().z(), of_plate = world.state.pistons[0].velocity.z();
    CHECK(of_plate - then > -1e-6 * gain);
    CHECK(mass * of_plate + m * then == within(1e-9, -2 * mass * gain));
}

TEST_CASE("a sphere rolls on a plate that is drawn away under it, until its friction is spent", "[physics][piston]")
{
    // The sphere is pressed on an upright plate that goes along z: what sticks has a_sphere = 2/7 a_plate, so
    // M a = F − 2/7 m a; what slips has μ m g for its friction.
    ContactLaw law;
    law.friction = 0.4;
    World world = make_world(law, rigid_settings(), h);
    world.model.gravity = Vec3(-standard_gravity, 0, 0);
    world.add_sphere(Vec3(r, 0.01, 0));
    const double mass = 0.02, m = world.mass();
    const double sticking_limit = 3.5 * law.friction * standard_gravity; // of the plate's acceleration
    const double a = GENERATE(0.5, 2.0) * sticking_limit;
    const bool sticks = a < sticking_limit;
    const double friction = sticks ? 2.0 / 7.0 * m * a : law.friction * m * standard_gravity;
    world.add_piston(Disk{Vec3::Zero(), Vec3::UnitX(), 0.1, 0.0}, mass, Vec3::UnitZ(), {{0.0, mass * a + friction}});
    constexpr int steps = 200;
    world.step(steps);
    CAPTURE(sticks);
    CHECK(world.state.pistons[0].velocity.z() == within(1e-6, a * h * steps));
    CHECK(world.velocity().z() == within(1e-6, friction / m * h * steps));
    CHECK(world.angular_velocity().y() * r == within(1e-6, 2.5 * friction / m * h * steps));
    CHECK(drift(world).across < no_drift);
    CHECK(drift(world).turn < no_drift);
}

TEST_CASE("what a plate in a jostling heap gains in momentum is what gravity, load, walls and guide give",
    "[physics][piston]")
{
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    ContactLaw law{.friction = 0.5, .restitution = 0.4, .rolling_friction = 0.1};
    World world = make_world(law, production_settings(stabilisation), h);
    const double load = 3.0;
    world.add_wall(box_panels({Vec3(-0.04, -0.04, 0), Vec3(0.04, 0.04, 0.2)}, {"z+"}));
    for (int k = 0; k < 27; ++k)
        world.add_sphere(0.011 * Vec3(k % 3 - 1.0, k / 3 % 3 - 1.1, 0.6 + k / 9), Vec3(0.3 - 0.02 * k, 0.1, -0.2));
    const std::size_t piston =
        world.add_piston(plate(Vec3(0.003, -0.002, 0.04), 0.035), 0.05, Vec3(0, 0.1, 1), {{0.0, -load}});
    const Vec3 guide = world.model.pistons[piston].guide, across = any_perpendicular(guide);
    double weights = 0.05;
    for (const Body& m : world.state.bodies) weights += 1.0 / m.inverse_mass;
    std::size_t contacts = 0;
    for (int k = 0; k < 500; ++k) {
        const Vec3 before = world.momentum();
        world.step();
        contacts += world.network.contacts.pistons.count();
        const auto& by_guide = world.state.pistons[piston].guide_impulse;
        const Vec3 given = h * (weights * world.model.gravity - load * guide) +
                           world.report.outcome.from_walls.impulse + by_guide[0] * across +
                           by_guide[1] * guide.cross(across);
        REQUIRE((world.momentum() - before - given).norm() < 1e-13);
    }
    CHECK(contacts > 400);
    CHECK(drift(world).across < no_drift);
    CHECK(drift(world).turn < no_drift);
}

TEST_CASE("a plate on soft spheres swings and settles where load and stiffness say", "[physics][piston]")
{
    // Three contacts in a row of stiffness k carry a third of the load: overlap F/(3k) above the sphere, and below it
    // with the sphere's weight too.
    const double k = 2000.0, mass = 0.05, load = 3.0;
    ContactLaw law;
    law.friction = 0.3;
    law.stiffness = k;
    World world = make_world(law, matched_settings(1e-10), h);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int i = 0; i < 3; ++i)
        world.add_sphere(0.02 * Vec3(std::cos(2.1 * i), std::sin(2.1 * i), 0.0) + Vec3(0, 0, r));
    world.add_piston(plate(Vec3(0, 0, 2.0 * r)), mass, Vec3(0, 0, -1), {{0.0, load}});
    world.step(20000);
    const double on_each = (mass * standard_gravity + load) / 3.0;
    const double sunk = on_each / k + (on_each + world.mass() * standard_gravity) / k;
    CHECK(travel(world.model.pistons[0], world.state.pistons[0]) == within(2e-2, sunk));
}

TEST_CASE("what a load does on a plate goes into its energy, or is lost", "[physics][piston]")
{
    World world = world_with_sphere(production_settings(Stabilisation::matched));
    world.model.gravity.setZero();
    const double mass = 0.3;
    world.add_piston(plate(Vec3(1, 0, 1)), mass, Vec3::UnitZ(), {{0.0, 1.0}, {0.02, 4.0}});
    double work = 0.0;
    for (int k = 0; k < 300; ++k) {
        world.step();
        work += world.report.bodies.load_work;
    }
    // Symplectic steps: Σ F v h = ½ M v² + Σ ½ (F h)²/M.
    const double kinetic = world.report.bodies.kinetic_energy;
    CHECK(kinetic == within(1e-12, kinetic_energy(world.model.pistons[0], world.state.pistons[0])));
    CHECK(work > kinetic);
    CHECK(work == within(1e-2, kinetic));
}

} // namespace talus::test
