// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/world.hpp"

#include <cmath>
#include <numbers>

namespace talus::test
{
namespace
{

constexpr double friction = 0.3;
constexpr double time_step = 2e-4;
constexpr double pi = std::numbers::pi;

/// A sphere at rest on the plane z = 0, which moves.
World sphere_on_moving_plane(const ContactLaw& law, const SolverSettings& solver, const WallMotion& motion)
{
    World world = make_world(law, solver, time_step);
    world.add_wall(Plane{}, motion);
    world.add_sphere(standard_radius * Vec3::UnitZ());
    return world;
}

void stop_spins(World& world)
{
    world.model.physics.spin = false;
}

} // namespace

TEST_CASE("a sphere laid on a belt rolls off with 2/7 of its speed", "[moving_walls][friction]")
{
    // Angular momentum about the contact line is kept: v + 2/5 r ω = 0, and v − r ω = V at the end, with ω about −y for
    // a belt along +x: v = 2/7 V. It slips for t* = 2 V / (7 μ g).
    const Vec3 belt(2.0, -1.0, 0);
    World world = sphere_on_moving_plane(
        {.friction = friction}, GENERATE(rigid_settings(), matched_settings()), {Translation{{}, belt}});
    const double duration = 2.0 * belt.norm() / (7.0 * friction * standard_gravity);
    const auto slip_speed = [&] { return (slip(world) - belt).norm(); };
    world.step(static_cast<int>(0.98 * duration / time_step));
    CHECK(slip_speed() > 0.01 * belt.norm());
    CHECK(world.velocity().head<2>().norm() ==
          within(0.01, friction * standard_gravity * world.state.time)); // and the weight has been carried throughout
    world.step(static_cast<int>(0.04 * duration / time_step));
    CHECK(slip_speed() < 1e-9);
    CHECK((world.velocity() - 2.0 / 7.0 * belt).head<2>().norm() < 1e-10);
    world.step(100);
    CHECK((world.velocity() - 2.0 / 7.0 * belt).head<2>().norm() < 1e-10);
}

TEST_CASE("a sphere that does not turn is taken along by a belt, at μ g until it has its speed", "[moving_walls][spin]")
{
    const Vec3 belt(0.8, 0.6, 0);
    World world = sphere_on_moving_plane(
        {.friction = friction}, GENERATE(rigid_settings(), matched_settings()), {Translation{{}, belt}});
    stop_spins(world);
    const double duration = 1.0 / (friction * standard_gravity);
    world.step(500);
    CHECK((world.velocity() - friction * standard_gravity * 500 * time_step * belt).head<2>().norm() <
          2 * friction * standard_gravity * time_step); // what `matched` takes to carry the weight
    world.step(static_cast<int>(duration / time_step) - 500 + 5);
    CHECK((world.velocity() - belt).head<2>().norm() < 1e-12);
    CHECK(world.angular_velocity() == Vec3::Zero());
}

TEST_CASE("bodies on a plate at constant velocity are those on a plate at rest, moved", "[moving_walls][invariance]")
{
    // Galileo: with the same relative velocities every step has the same impulses. The tolerance is what round-off
    // makes of some bounces. An open contact closes to the point: whether the gap is then 0 or 1e-18 is chance, and
    // under `matched` it decides the law of one step; so that law is followed up to the first such landing.
    const auto [solver, steps] =
        GENERATE(table<SolverSettings, int>({{rigid_settings(), 1000}, {matched_settings(), 400}}));
    const Vec3 velocity(3.0, -1.0, 0.5);
    const auto scene = [&, &law = solver](const Vec3& v, const WallMotion& motion) {
        World world = make_world({.friction = 0.4, .restitution = 0.5, .rolling_friction = 0.05}, law, time_step);
        world.add_wall(box_panels({Vec3(-0.03, -0.03, 0), Vec3(0.03, 0.03, 0.1)}, {"z+"}), motion);
        for (int k = 0; k < 12; ++k)
            world.add_sphere(Vec3(0.013 * (k % 2) - 0.005, 0.012 * (k / 2 % 3) - 0.012, 0.02 + 0.012 * (k / 4)),
                v + Vec3(0.31 - 0.107 * (k % 5), 0.203 * (k % 3) - 0.197, -0.211), Vec3(10.0 * k, -20, 5),
                0.004 + 0.0001 * k);
        return world;
    };
    World still = scene(Vec3::Zero(), {});
    World moving = scene(velocity, {Translation{{}, velocity}});
    std::size_t contacts = 0;
    for (int step = 0; step < steps; ++step) {
        still.step();
        moving.step();
        contacts += still.report.contacts.count;
    }
    REQUIRE(contacts > (steps == 1000 ? 1000 : 20));
    const Vec3 moved = still.state.time * velocity;
    for (int id = 0; id < 12; ++id) {
        CHECK((moving.position(id) - still.position(id) - moved).norm() < 1e-7 * standard_radius);
        CHECK((moving.velocity(id) - still.velocity(id) - velocity).norm() < 1e-7);
        CHECK((moving.angular_velocity(id) - still.angular_velocity(id)).norm() < 1e-4); // ω ~ 1e2
    }
}

TEST_CASE("a sphere stays on a plate shaken with less than g", "[moving_walls]")
{
    // a = A (2π f)² = 0.9 g. The rigid law has the plate's velocity of each step, which moves the sphere with it.
    const double frequency = 30.0;
    const double amplitude = 0.9 * standard_gravity / std::pow(2 * pi * frequency, 2);
    World world = sphere_on_moving_plane({}, rigid_settings(), {Shaking{{}, amplitude * Vec3::UnitZ(), frequency}});
    world.state.body(0).velocity.z() = 2 * pi * frequency * amplitude; // as the plate
    double worst = 0.0;
    for (int step = 0; step < 1000; ++step) {
        world.step();
        const double plate = amplitude * std::sin(2 * pi * frequency * world.state.time);
        worst = std::max(worst, std::abs(world.position().z() - standard_radius - plate));
        REQUIRE(world.contact_forces().size() == 1);
    }
    CHECK(worst < 1e-8 * amplitude + 2e-9); // the first step knows nothing of how the plate moved before it
}

TEST_CASE("a sphere on a plate that gets ever faster overlaps it as on one at rest with more gravity", "[moving_walls]")
{
    // In the plate's own frame v⁽⁰⁾ is what it was relative to the plate in the step before, and a is added to g. On
    // one at rest q_n = −4Υ g/h at the end, so that the overlap is Σ_n m (g + a) h²/(4Υ), with Σ_n = 0.1/m.
    const double a = GENERATE(1.0, -0.5) * standard_gravity;
    constexpr int steps = 200;
    Course course;
    for (int k = 0; k <= steps; ++k)
        course.waypoints.push_back({k * time_step, 0.5 * a * std::pow(k * time_step, 2) * Vec3::UnitZ()});
    World world = sphere_on_moving_plane({}, matched_settings(), {course});
    world.step(steps);
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    CHECK(forces[0].normal_force == within(1e-9, world.mass() * (standard_gravity + a)));
    CHECK(-forces[0].gap == within(1e-9, 0.1 * (standard_gravity + a) * time_step * time_step / (4.0 / 9.0)));
}

TEST_CASE("a sphere leaves a plate shaken with more than g where the plate falls faster", "[moving_walls]")
{
    // −a sin(φ) a phase later: A (2π f)² sin φ = g; from there it flies freely, z = z₀ + v₀ t − g t²/2.
    const double frequency = 20.0, ratio = 2.0, omega = 2 * pi * frequency;
    const double amplitude = ratio * standard_gravity / (omega * omega);
    World world = sphere_on_moving_plane({}, rigid_settings(), {Shaking{{}, amplitude * Vec3::UnitZ(), frequency}});
    world.state.body(0).velocity.z() = omega * amplitude;
    const double expected = std::asin(1.0 / ratio) / omega;
    double left = -1.0;
    while (world.state.time < 2 * expected && left < 0.0) {
        const double begin = world.state.time;
        world.step();
        bool loaded = false;
        for (const auto& force : world.contact_forces()) loaded = loaded || force.normal_force > 0.0;
        if (!loaded) left = begin;
    }
    CHECK(std::abs(left - expected) <= 2 * time_step);
    // Half a period of flight further on: speed and height of the throw.
    world.step(50);
    const double flight = world.state.time - expected;
    const double z = amplitude * std::sin(omega * expected) + amplitude * omega * std::cos(omega * expected) * flight -
                     0.5 * standard_gravity * flight * flight;
    CHECK(world.position().z() - standard_radius == Approx(z).margin(2e-5)); // 1.2 mm high; one step at 0.6 g
}

TEST_CASE("an impact on a moving wall turns the relative velocity round", "[moving_walls]")
{
    // e = 0.7, the racket comes at 2 m/s, the ball at −3: leaves with 2 + 0.7 · 5.
    World world = make_world({.restitution = 0.7}, GENERATE(rigid_settings(), matched_settings()), time_step);
    world.model.gravity.setZero();
    world.add_wall(Plane{}, {Translation{{}, Vec3(0, 0, 2.0)}});
    world.add_sphere(Vec3(0, 0, standard_radius + 0.003), Vec3(0, 0, -3.0));
    world.step(20);
    CHECK(world.velocity().z() == within(1e-12, 5.5));
}

TEST_CASE("a sphere that does not turn rests in a turning drum at the angle of friction", "[moving_walls][spin]")
{
    // The drum turns about y; where the slope is atan μ, friction of the sliding wall balances the weight.
    const double rate = 2.0, radius = 0.05;
    World world = make_world({.friction = friction}, GENERATE(rigid_settings(), matched_settings()), time_step);
    world.add_wall(
        Cylinder{Vec3(0, -0.05, 0), Vec3::UnitY(), radius, 0.1}, {Turning{{}, Vec3::Zero(), Vec3::UnitY(), rate}});
    stop_spins(world);
    const double angle = std::atan(friction), arm = radius - standard_radius;
    // It would swing about its place with hardly any damping: laid down there, it must stay.
    const Vec3 place = arm * Vec3(-std::sin(angle), 0, -std::cos(angle));
    world.add_sphere(place);
    world.step(2000);
    CHECK((world.position() - place).norm() < 1e-3 * radius);
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    CHECK(forces[0].tangent_force.norm() == within(1e-9, friction * forces[0].normal_force));
    // Laid down at the bottom it is taken up to there first.
    World from_below = world;
    from_below.state.position[0] = -arm * Vec3::UnitZ();
    from_below.state.body(0).velocity.setZero();
    double mean = 0.0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
        from_below.step();
        mean -= from_below.position().x() / steps;
    }
    CHECK(std::asin(mean / arm) == Approx(angle).epsilon(0.05));
}

TEST_CASE("rolling resistance at a turning wall is against the spin relative to it", "[moving_walls][rolling]")
{
    // A sphere on the axis of a turning plate: no slip, and no row resists spin about the normal. On a plate that turns
    // about an axis in its plane the sphere that turns along feels no resistance, one that does not feels all of it.
    const double rate = 20.0, rolling = 0.02;
    World world = make_world({.friction = 1.0, .rolling_friction = rolling}, rigid_settings(), 1e-5);
    world.add_wall(
        Disk{Vec3::Zero(), Vec3::UnitZ(), 0.1}, {Turning{{}, standard_radius * Vec3::UnitZ(), Vec3::UnitZ(), rate}});
    world.add_sphere(standard_radius * Vec3::UnitZ());
    world.step(10);
    CHECK(world.angular_velocity().norm() < 1e-9);

    World tipped = make_world({.friction = 1.0, .rolling_friction = rolling}, rigid_settings(), 1e-5);
    tipped.add_wall(Disk{Vec3::Zero(), Vec3::UnitZ(), 0.1}, {Turning{{}, Vec3::Zero(), Vec3::UnitY(), rate}});
    tipped.add_sphere(standard_radius * Vec3::UnitZ(), Vec3(rate * standard_radius, 0, 0), rate * Vec3::UnitY());
    tipped.step(1); // as one body with the plate: neither slip nor relative spin, and no rolling impulse
    const auto& walls = tipped.network.contacts.walls[0];
    REQUIRE(tipped.report.contacts.count == 1);
    const double size = walls.rolling(0).reach * walls.impulse(0).dot(walls.normal(0));
    CHECK(size > 0.0);
    CHECK(walls.rolling_impulse(0).norm() < 1e-2 * size);
    tipped.state.body(0).rim_velocity.setZero(); // at rest it is dragged with the whole resistance
    tipped.step(1);
    const double whole = walls.rolling(0).reach * walls.impulse(0).dot(walls.normal(0));
    CHECK(walls.rolling_impulse(0).y() == within(1e-3, whole));
}

TEST_CASE("torque times rate and force times velocity are what walls put in, and dissipation is never negative",
    "[moving_walls][energy]")
{
    // Beads without restitution in a drum that turns and is lifted, with rigid contacts. In every step
    // work of gravity + work of the walls = change of the kinetic energy + what contacts dissipate.
    const bool spin = GENERATE(true, false);
    const double rate = 12.0;
    World world =
        make_world({.friction = 0.5, .rolling_friction = spin ? 0.05 : 0.0}, rigid_settings(1e-12, 5000), time_step);
    world.model.physics.wall_loads = true;
    if (!spin) stop_spins(world);
    const Vec3 lift(0.1, 0, 0.3);
    const Vec3 axis(0.6, 0.8, 0);
    world.add_wall(Cylinder{Vec3(0.01, 0, 0.02) - 0.015 * axis, axis, 0.03, 0.03},
        {Turning{{}, Vec3(0.01, 0, 0.02), axis, rate}, Translation{{}, lift}});
    for (const double side : {-1.0, 1.0})
        world.add_wall(Disk{Vec3(0.01, 0, 0.02) + 0.015 * side * axis, axis, 0.04}, {Translation{{}, lift}});
    for (int k = 0; k < 8; ++k)
        world.add_sphere(Vec3(0.01, 0, 0.02) + 0.009 * (k % 2 - 0.5) * axis +
                             0.009 * (k / 2 % 2 - 0.5) * Vec3(0.8, -0.6, 0) + 0.009 * (k / 4 - 0.5) * Vec3::UnitZ(),
            lift, Vec3::Zero(), 0.004);
    double dissipated = 0.0, work = 0.0, least = 0.0, largest_work = 0.0;
    for (int step = 0; step < 800; ++step) {
        double before = kinetic_energy(world.state), gravity_work = 0.0;
        std::vector<Vec3> old;
        for (const auto& m : world.state.bodies) old.push_back(m.velocity);
        const double start = world.state.time;
        world.step();
        // The impulses of gravity and of contacts act at the mean of the velocities before and after: T₁ − T₀ =
        // Σ p·(v₀ + v₁)/2.
        for (std::size_t i = 0; i < world.state.count(); ++i)
            gravity_work += world.state.mass(i) * time_step *
                            world.model.gravity.dot(0.5 * (old[i] + world.state.body(i).velocity));
        const double loss = gravity_work + world.report.outcome.wall_work - (kinetic_energy(world.state) - before);
        least = std::min(least, loss);
        dissipated += loss;
        work += world.report.outcome.wall_work;

        double power = 0.0;
        for (std::size_t w = 0; w < world.model.walls.size(); ++w) {
            const auto& motion = world.model.walls[w].motion;
            const Twist twist = twist_between(pose_at(motion, start), pose_at(motion, start + time_step), time_step);
            power -= world.report.wall_loads[w].impulse.dot(twist.velocity) +
                     world.report.wall_loads[w].torque.dot(twist.spin);
        }
        largest_work = std::max(largest_work, std::abs(power));
        REQUIRE(world.report.outcome.wall_work == Approx(power).margin(1e-9 * largest_work));
    }
    CHECK(work > 0.0);
    CHECK(dissipated > 0.0);
    CHECK(least > -1e-6 * dissipated); // the solver's tolerance
}

} // namespace talus::test
