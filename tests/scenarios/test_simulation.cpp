// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

/// A simulation in which only what the test puts there stands and lies.
Simulation empty_simulation()
{
    auto simulation = build_scene(small_scene()).simulation;
    simulation.state = State{};
    return simulation;
}

void add_bead(Simulation& simulation, const Vec3& position)
{
    add_sphere(simulation.state, position, 0.005, 2500.0, 0);
}

} // namespace

TEST_CASE("spheres that touch without overlap are none", "[check_overlaps]")
{
    auto simulation = empty_simulation();
    add_bead(simulation, Vec3(0.01, 0.01, 0.1));
    add_bead(simulation, Vec3(0.0201, 0.01, 0.1));
    CHECK(check_overlaps(simulation).count == 0);
    CHECK(check_overlaps(build_scene(small_scene()).simulation).count == 0); // as every fill
}

TEST_CASE("the worst of several overlaps is reported with both spheres", "[check_overlaps]")
{
    auto simulation = empty_simulation();
    add_bead(simulation, Vec3(0.01, 0.01, 0.1));
    add_bead(simulation, Vec3(0.0195, 0.01, 0.1)); // 0.5 mm into the first
    add_bead(simulation, Vec3(0.0285, 0.01, 0.1)); // 1 mm into the second
    const auto check = check_overlaps(simulation);
    CHECK(check.count == 2);
    CHECK(check.worst == Approx(1e-3));
    CHECK(std::min(check.id_a, check.id_b) == 1);
    CHECK(std::max(check.id_a, check.id_b) == 2);
    CHECK(check.wall == -1);
}

TEST_CASE("an overlap with a wall is reported with the wall", "[check_overlaps]")
{
    auto simulation = empty_simulation();
    add_bead(simulation, Vec3(0.02, 0.02, 0.003)); // 2 mm into the floor of the box
    const auto check = check_overlaps(simulation);
    CHECK(check.count == 1);
    CHECK(check.worst == Approx(2e-3));
    CHECK(check.id_a == 0);
    CHECK(check.id_b == -1);
    CHECK(check.wall == 0);
}

TEST_CASE("a wall that does not stand yet overlaps nothing", "[check_overlaps]")
{
    auto scene = small_scene();
    scene.wall[0].appear_at = 1.0;
    auto simulation = build_scene(scene).simulation;
    simulation.state = State{};
    add_bead(simulation, Vec3(0.02, 0.02, 0.003));
    CHECK(check_overlaps(simulation).count == 0);
}

TEST_CASE("a run that pours and empties keeps its ledger", "[simulation]")
{
    auto scene = small_scene();
    scene.wall.clear();
    scene.pour.push_back(small_pour());
    scene.outlet = {{"below", box_region(Vec3(-1, -1, -0.2), Vec3(1, 1, -0.05))}};
    auto simulation = build_scene(scene).simulation;
    double inserted_mass = 0.0;
    std::int64_t weighed = 0;
    while (simulation.state.time < 0.4) { // twice the longest fall, of 0.25 m
        advance(simulation);
        for (std::size_t i = 0; i < simulation.state.count(); ++i)
            if (simulation.state.id[i] >= weighed) inserted_mass += simulation.state.mass(i);
        weighed = simulation.state.next_id;
        const auto inside = static_cast<std::int64_t>(simulation.state.count());
        CHECK(simulation.state.next_id == inside + simulation.outflow.count);
    }
    CHECK(simulation.pours[0].poured == 5);
    CHECK(simulation.outflow.count == 25);
    CHECK(simulation.outflow.mass == Approx(inserted_mass));
}

TEST_CASE("steps are made until the time, each reported once, or until a hook wants no more", "[simulation]")
{
    auto simulation = build_scene(small_scene()).simulation;
    const double h = simulation.model.time_step;
    int told = 0;
    const auto count = [&](const StepReport&) { ++told; };
    run_until(simulation, 20.0 * h, {.after_step = count});
    CHECK(told == 20);
    run_until(simulation, 20.0 * h, {.after_step = count});
    CHECK(told == 20);
    run_until(simulation, 40.0 * h, {.before_step = [&] { return told < 30; }, .after_step = count});
    CHECK(simulation.state.steps == 30);
}

TEST_CASE("an escape ends the steps, or the sphere is taken out before the next one", "[simulation]")
{
    const bool removed = GENERATE(false, true);
    auto scene = small_scene();
    scene.world.on_escape = removed ? "remove" : "stop";
    auto simulation = build_scene(scene).simulation;
    const auto spheres = simulation.state.count();
    simulation.state.position[3].z() = simulation.model.world.min.z();
    simulation.state.body(3).velocity = Vec3(0, 0, -1);
    const StepReport last = run_until(simulation, 10.0 * simulation.model.time_step, {});
    CHECK(simulation.state.steps == (removed ? 10 : 1));
    CHECK(simulation.incident_policy.stops(last) == !removed);
    CHECK(simulation.state.count() == spheres - (removed ? 1 : 0));
    CHECK(simulation.escaped.size() == (removed ? 1 : 0));
}
