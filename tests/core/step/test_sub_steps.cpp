// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/archive.hpp"
#include "core/base/region.hpp"
#include "core/step/time_step.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <omp.h>

namespace talus::test
{
namespace
{

constexpr double d = 2 * standard_radius;
const double time_step = automatic_step();
const double push_out_speed = automatic_push_out_speed();

ContactLaw law_of(double restitution, double friction = 0.0)
{
    return {friction, restitution, 0.0, infinity};
}

/// A closed box of thin panels round the origin.
void add_box(World& world, double edge)
{
    world.add_wall(box_panels({Vec3::Constant(-0.5 * edge), Vec3::Constant(0.5 * edge)}, {}));
}

/// Ten spheres on top of each other on the floor, settled.
World stack(Stabilisation stabilisation)
{
    World world = make_world(law_of(0.0, 0.5), production_settings(stabilisation), time_step);
    world.model.solver.push_out_speed = push_out_speed;
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < 10; ++k) world.add_sphere(Vec3(0, 0, (k + 0.5) * d));
    world.step(15000);
    return world;
}

/// Two spheres far from the origin, and apart. Returns the id of the first; the other has the next.
std::int64_t add_pair_far_off(World& world)
{
    const auto first = world.add_sphere(Vec3(1000, 0, 100));
    world.add_sphere(Vec3(1000 + 10 * d, 0, 100));
    return first;
}

/// They are where they were, and meet in the next step at 100 m/s.
void let_meet(World& world, std::int64_t first)
{
    for (const int side : {0, 1}) {
        world.state.position[world.index_of(first + side)] = Vec3(1000 + 1.01 * d * side, 0, 100);
        world.state.body(world.index_of(first + side)).velocity = Vec3(side ? -50 : 50, 0, 0);
    }
}

/// 200 spheres of two sizes that fly about in a closed box at up to 60 m/s, so that nearly every step is split.
World fast_gas(Stabilisation stabilisation)
{
    World world = make_world(law_of(0.8, 0.3), production_settings(stabilisation), time_step);
    world.model.solver.push_out_speed = push_out_speed;
    add_box(world, 0.14);
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const Vec3 place = 0.02 * Vec3(i % 6 - 2.5, i / 6 % 6 - 2.5, i / 36 - 2.5);
        const Vec3 direction(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
        world.add_sphere(place, 60.0 * direction, 1e3 * direction, i % 3 ? 0.5 * d : 0.3 * d);
    }
    return world;
}

template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

} // namespace

TEST_CASE("a step is split where two come more than 0.2 d nearer in it, and takes its time", "[sub_steps]")
{
    const double way = GENERATE(0.19, 0.21, 2.0, 20.0) * d;
    const bool wall = GENERATE(false, true);
    const Vec3 far(1, 1000, 0), speed(way / 1e-3, 0, 0);
    World world = make_world(law_of(1.0), production_settings(Stabilisation::matched), 1e-3);
    world.model.gravity = Vec3::Zero();
    world.add_sphere(Vec3(standard_radius + 0.5 * way, 0, 0), -speed);
    const auto beside = world.add_sphere(far, speed);
    if (wall)
        world.add_plane(Vec3::Zero(), Vec3::UnitX());
    else
        world.add_sphere(Vec3(-standard_radius, 0, 0));
    world.step();
    CHECK((world.report.sub_steps > 1) == (way > 0.2 * d));
    CHECK(way / world.report.sub_steps <= 0.2 * d);
    if (way > 0.2 * d) {
        CHECK(world.report.split_for.speed == within(1e-12, way / 1e-3));
        const auto [other, sphere] = std::minmax(world.report.split_for.sphere, world.report.split_for.other);
        CHECK(sphere == (wall ? 0 : 2));
        CHECK(other == (wall ? -1 : 0));
        CHECK(world.report.split_for.wall == (wall ? 0 : -1));
    }
    CHECK(world.state.steps == 1);
    CHECK(world.state.time == 1e-3);
    world.step(7);
    CHECK(world.report.sub_steps == 1);
    CHECK(world.state.time == 8 * 1e-3);
    CHECK(world.position(beside).x() == within(1e-13, 1.0 + 8 * 1e-3 * speed.x()));
}

TEST_CASE("a free fall does not depend on how its steps are split", "[sub_steps]")
{
    World world = make_world(law_of(0.0), production_settings(Stabilisation::matched), 1e-3);
    const auto falling = world.add_sphere(Vec3::Zero(), Vec3(100, 0, 0));
    const auto pair = add_pair_far_off(world);
    for (int k = 0; k < 100; ++k) {
        if (k % 3 != 0) let_meet(world, pair);
        world.step();
        REQUIRE((world.report.sub_steps > 10) == (k % 3 != 0));
    }
    CHECK(world.velocity(falling).z() == within(1e-12, -standard_gravity * 0.1));
    CHECK(world.position(falling).x() == within(1e-12, 10.0));
}

TEST_CASE("what is fast and meets nothing splits no step", "[sub_steps]")
{
    // It falls alone, beside others, along a wall, and behind a wall that is as fast.
    World world = make_world(law_of(0.0, 0.5), production_settings(Stabilisation::matched), 1e-3);
    world.add_wall(Plane{Vec3(0, 0, -standard_radius), Vec3::UnitZ()}, {Translation{{}, Vec3(100, 0, 0)}});
    world.model.gravity = Vec3::Zero();
    for (int k = 0; k < 5; ++k) world.add_sphere(Vec3(1.001 * k * d, 0, 0), Vec3(100, 0, 0));
    world.add_sphere(Vec3(0, 5 * d, 50 * d), Vec3(-300, 0, 0));
    for (int k = 0; k < 50; ++k) {
        world.step();
        REQUIRE(world.report.sub_steps == 1);
    }
    CHECK(world.position(0).x() == within(1e-12, 5.0));
}

TEST_CASE("a scene that is seen from a moving frame has the same steps", "[sub_steps]")
{
    const Vec3 frame(20, -70, 40);
    World still = make_world(law_of(0.5, 0.3), matched_settings(), 5 * time_step);
    still.model.gravity = Vec3::Zero();
    Random random(3);
    for (int i = 0; i < 60; ++i) {
        const Vec3 place = 1.5 * d * Vec3(i % 4 - 1.5, i / 4 % 4 - 1.5, i / 16 - 1.5);
        still.add_sphere(place, -100.0 * place + Vec3(uniform(random), uniform(random), uniform(random)));
    }
    World moving = still;
    for (Body& body : moving.state.bodies) body.velocity += frame;
    int split = 0;
    for (int k = 0; k < 60; ++k) {
        still.step();
        moving.step();
        REQUIRE(still.report.sub_steps == moving.report.sub_steps);
        split += still.report.sub_steps > 1;
    }
    CHECK(split > 0);
    for (int i = 0; i < 60; ++i)
        CHECK((moving.position(i) - frame * moving.state.time - still.position(i)).norm() < 1e-6 * d);
}

TEST_CASE("a plate without thickness that crosses a sphere in one step takes it along", "[sub_steps]")
{
    World world = make_world(law_of(0.0), production_settings(Stabilisation::matched), 1e-3);
    world.model.gravity = Vec3::Zero();
    world.add_wall(Disk{Vec3::Zero(), Vec3::UnitX(), 0.1, 0.0}, {Translation{{}, Vec3(100, 0, 0)}});
    world.add_sphere(Vec3(standard_radius + 0.02, 0, 0)); // the plate moves by 10 d in a step
    world.step(3);
    CHECK(world.position().x() > 100.0 * world.state.time);
}

TEST_CASE("a stack at rest does not notice steps that are split for what is far off", "[sub_steps]")
{
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World alone = stack(stabilisation), world = alone;
    const auto fast = add_pair_far_off(world);
    const double weight = 10 * world.mass(0) * standard_gravity;
    double farthest = 0.0, liveliest = 0.0, worst_force = 0.0, worst_energy = 0.0;
    int most_sub_steps = 1;
    for (int round = 0; round < 40; ++round) {
        for (int k = 0; k < 50; ++k) {
            if (round % 2) let_meet(world, fast);
            world.step();
            alone.step();
            most_sub_steps = std::max(most_sub_steps, world.report.sub_steps);
            worst_energy = std::max(
                worst_energy, std::abs(world.report.contacts.stored_energy - alone.report.contacts.stored_energy));
            worst_force =
                std::max(worst_force, std::abs(world.report.outcome.from_walls.impulse.z() / time_step / weight - 1));
            for (int i = 0; i < 10; ++i) {
                farthest = std::max(farthest, (world.position(i) - alone.position(i)).norm());
                liveliest = std::max(liveliest, world.state.body(world.index_of(i)).kinetic_energy());
            }
            for (const auto& contact : world.contact_forces())
                if (contact.with_wall) worst_force = std::max(worst_force, std::abs(contact.normal_force / weight - 1));
        }
    }
    CHECK(0.1 * d * most_sub_steps >= 100.0 * time_step);
    CHECK(0.1 * d * most_sub_steps < 200.0 * time_step);
    CHECK(farthest < 1e-6 * d);
    CHECK(liveliest < 1e-12 * world.mass(0) * standard_gravity * d);
    CHECK(worst_force < 1e-3);
    CHECK(worst_energy <= 1e-3 * alone.report.contacts.stored_energy);
}

TEST_CASE("what is too slow to rebound in a step is so in its parts", "[sub_steps]")
{
    // 1.5 g h; impacts from 3 g h on rebound, and the step has 32 parts.
    World world = make_world(law_of(1.0), production_settings(Stabilisation::projected), time_step);
    world.model.solver.push_out_speed = push_out_speed;
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0, 0, 0.5 * d), Vec3(0, 0, -1.5 * standard_gravity * time_step));
    let_meet(world, add_pair_far_off(world));
    world.step();
    CHECK(world.report.sub_steps > 20);
    CHECK(std::abs(world.velocity(0).z()) < 0.1 * standard_gravity * time_step);
}

TEST_CASE("the first whole step after a blow is solved as well as any", "[sub_steps]")
{
    // The ball of 30 m/s splits steps until it strikes. Then the impulses of the last part go on, as large as in a
    // whole step; measured against these, with a blow among them, the corrections of the bed would be small far too
    // soon.
    const double height = GENERATE(0.0, 0.2, 0.4);
    World world = stack(Stabilisation::matched);
    world.add_sphere(Vec3(0, 0, (10.51 + height) * d), Vec3(0, 0, -30));
    advance_until(
        world, [](const World& w) { return w.velocity(10).z() > -0.2 * d / time_step; }, 20);
    REQUIRE(world.report.sub_steps > 1);
    World exact = world;
    exact.model.solver = matched_settings();
    exact.step();
    world.step();
    REQUIRE(world.report.sub_steps == 1);
    double worst = 0.0;
    for (int i = 0; i < 11; ++i) worst = std::max(worst, (world.velocity(i) - exact.velocity(i)).norm());
    CHECK(worst < 0.3 * exact.velocity(0).norm()); // 0.1; 0.7 where the blow counts
}

TEST_CASE("a light sphere between a heavy fast one and a thin wall stays on its side", "[sub_steps]")
{
    // The heavy one is 1000 times as heavy. Struck without loss the light one leaves twice as fast, within the step,
    // towards a wall that it did not approach; then it is pressed against it with all that the heavy one has.
    const double e = GENERATE(0.0, 1.0);
    const double gap = GENERATE(0.0, 0.011, 0.2, 0.49, 1.3, 5.0) * d;
    const double step = GENERATE(1e-5, 1e-4, 1e-3);
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World world = make_world(law_of(e), production_settings(stabilisation), step);
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = push_out_speed;
    world.add_wall(Disk{Vec3::Zero(), Vec3::UnitZ(), 0.2, 0.0});
    const double above = standard_radius + gap;
    const auto light = world.add_sphere(Vec3(0, 0, above));
    const auto heavy = world.add_sphere(
        Vec3(0.02 * d, 0, above + 1.7 * d), Vec3(0, 0, -100), Vec3::Zero(), standard_radius, 1000 * standard_density);
    double lowest = infinity;
    for (double time = 0.0; time < 2e-3; time += step) {
        world.step();
        lowest = std::min({lowest, world.position(light).z(), world.position(heavy).z()});
    }
    CHECK(lowest > 0.0);
    CHECK(world.velocity(heavy).norm() <= 100.0 * (1 + 1e-9));
}

TEST_CASE("a wall that moves at 100 m/s does not pass a sphere", "[sub_steps]")
{
    const double place = GENERATE(0.5, 1.7, 3.3, 9.1) * d;
    World world = make_world(law_of(0.0), production_settings(Stabilisation::matched), 1e-3);
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = push_out_speed;
    world.add_wall(Disk{Vec3::Zero(), Vec3::UnitX(), 0.1, 0.0}, {Translation{{}, Vec3(100, 0, 0)}});
    world.add_sphere(Vec3(standard_radius + place, 0, 0));
    world.step(5);
    CHECK(world.position().x() - 100.0 * world.state.time > 0.95 * standard_radius);
    CHECK(world.velocity().x() == within(0.04, 100.0)); // a soft impact gives back a few per cent
}

TEST_CASE("a fast gas is the same bits after a restart, and with any number of threads", "[sub_steps][determinism]")
{
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World through = fast_gas(stabilisation);
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    through.step(60);
    Archive stored;
    stored(through.state, through.network);
    Archive archive(stored.bytes());
    World resumed = fast_gas(stabilisation);
    archive(resumed.state, resumed.network);
    int split = 0;
    for (int k = 0; k < 60; ++k) {
        through.step();
        split += through.report.sub_steps > 1;
    }
    CHECK(split > 50);
    omp_set_num_threads(3);
    resumed.step(60);
    omp_set_num_threads(before);
    CHECK(same_bits(through.state.position, resumed.state.position));
    CHECK(same_bits(through.state.bodies, resumed.state.bodies));
}

TEST_CASE("a step that is taken back leaves no trace", "[sub_steps]")
{
    // What contacts have pressed, between spheres and at the wall, is that of the step that was made.
    World world = stack(Stabilisation::matched);
    world.state.body(9).velocity.z() = -0.2;
    world.step(20);
    world.state.body(world.index_of(9)).velocity.z() = -0.5 * d / time_step;
    World tried = world;
    for (const double length : {time_step, 0.5 * time_step, time_step})
        REQUIRE_FALSE(advance_once({length}, false, tried.state, tried.network, tried.model, {}));
    world.step(20);
    tried.step(20);
    for (int k = 0; k < 10; ++k) CHECK(tried.position(k).z() == within(1e-13, world.position(k).z()));
}

TEST_CASE("a step in which impulses throw something far is taken back, and split", "[sub_steps]")
{
    // Two heavy spheres close on a light one from both sides, nearly in a line, by 0.15 d each: it leaves at 3 to 6
    // times their speed.
    const double e = GENERATE(0.0, 1.0);
    const double up = 0.3, across = std::sqrt(1 - up * up), speed = 0.15 * d / time_step / across;
    World world = make_world(law_of(e), production_settings(Stabilisation::matched), time_step);
    world.model.gravity = Vec3::Zero();
    world.model.solver.push_out_speed = push_out_speed;
    world.add_sphere(Vec3::Zero());
    for (const double side : {-1.0, 1.0})
        world.add_sphere(d * Vec3(side * across, 0, -up), Vec3(-side * speed, 0, 0), Vec3::Zero(), standard_radius,
            1000 * standard_density);
    World tried = world;
    REQUIRE_FALSE(advance_once({time_step}, false, tried.state, tried.network, tried.model, {}));
    for (int k = 0; k < 3; ++k) {
        CHECK(tried.velocity(k) == world.velocity(k));
        CHECK(tried.position(k) == world.position(k));
    }
    world.step();
    CHECK(world.report.sub_steps > 1);
    CHECK(world.velocity(0).z() > 0.4 * d / time_step);
    CHECK(world.velocity(0).z() * time_step / world.report.sub_steps <= 0.4 * d);
}

} // namespace talus::test
