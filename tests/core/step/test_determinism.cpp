// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/step/time_step.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <omp.h>

using namespace talus;

namespace
{

/// 1500 spheres of two sizes, rolling resistance and restitution, thrown into a box with a tilted plate.
State agitated_box(Model& model, std::uint64_t seed)
{
    model.materials = {{{"grain", 2500.0}}, {{0.4, 0.3, 0.05, infinity}}};
    model.physics = {.friction = true, .spin = true, .rolling = true, .restitution = true};
    model.time_step = 2e-4;
    model.min_diameter = 0.008;
    model.max_diameter = 0.012;
    model.mean_diameter = 0.01;
    model.world = Box{Vec3::Constant(-10), Vec3::Constant(10)};
    model.walls.push_back({"box", box_panels({Vec3::Zero(), Vec3(0.13, 0.13, 0.3)}, {}), 0});
    model.walls.push_back({"plate", Disk{Vec3(0.06, 0.06, 0.03), Vec3(0.3, 0.1, 1).normalized(), 0.04, 0.01}, 0});
    State state;
    Random random(seed);
    for (int i = 0; i < 1500; ++i) {
        const Vec3 place = 0.0128 * Vec3(0.5 + i % 10, 0.5 + i / 10 % 10, 5.0 + static_cast<double>(i / 100));
        const Vec3 velocity(uniform(random) - 0.5, uniform(random) - 0.5, -uniform(random));
        add_sphere(state, place, i % 3 ? 0.004 : 0.006, 2500.0, 0, velocity, 30.0 * velocity);
    }
    return state;
}

/// The state after some steps with this number of threads.
State run(int threads, Stabilisation stabilisation)
{
    Model model;
    model.solver.stabilisation = stabilisation;
    model.solver.push_out_speed = 0.03;
    auto state = agitated_box(model, 7);
    ContactNetwork network;
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    for (int k = 0; k < 400; ++k) advance(state, network, model);
    omp_set_num_threads(before);
    return state;
}

template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// The box open along x and y, with periodic axes in their place, on a floor of grains that is shaken; the plate turns.
State run_stirred(int threads)
{
    Model model;
    auto state = agitated_box(model, 8);
    model.periodicity.length = Vec3(0.13, 0.13, infinity);
    model.physics.moving_walls = true;
    model.walls[0].shape = grain_bed({Vec3(0, 0, 0.003), Vec3(0.13, 0.13, 0.003)}, 0.01, 0.012);
    model.walls[0].motion = {Shaking{{}, Vec3(0.002, 0, 0.001), 30.0}};
    model.walls[1].motion = {Turning{{}, Vec3(0.1, 0.1, 0.03), Vec3::UnitX(), 20.0}};
    ContactNetwork network;
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    for (int k = 0; k < 150; ++k) advance(state, network, model);
    omp_set_num_threads(before);
    return state;
}

/// The box with a plate that is pressed down on the spheres, and turns none of them away.
State run_pressed(int threads)
{
    Model model;
    auto state = agitated_box(model, 9);
    model.physics.pistons = true;
    model.walls[1].piston = 0;
    model.pistons.push_back({.wall = 1,
        .mass = 0.3,
        .guide = Vec3(0, 0.1, -1).normalized(),
        .center = Vec3(0.06, 0.06, 0.03),
        .inertia = block_inertia(0.3, Vec3(0.08, 0.08, 0.01)),
        .load = {{0.0, 5.0}}});
    state.pistons.resize(1);
    state.pistons[0].pose.shift = -0.22 * model.pistons[0].guide;
    ContactNetwork network;
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    for (int k = 0; k < 600; ++k) advance(state, network, model);
    omp_set_num_threads(before);
    return state;
}

} // namespace

TEST_CASE("every thread count gives the same bits with a piston", "[gauss_seidel][determinism][piston]")
{
    const auto one = run_pressed(1);
    CHECK(one.pistons[0].guide_impulse.norm() > 0.0); // it has met spheres: its guide would have nothing to do else
    for (const int threads : {2, 3, 4}) {
        const auto many = run_pressed(threads);
        CAPTURE(threads);
        CHECK(same_bits(one.position, many.position));
        CHECK(same_bits(one.bodies, many.bodies));
        CHECK(same_bits(one.pistons, many.pistons));
    }
}

TEST_CASE("every thread count gives the same bits with periodic axes and walls that move",
    "[gauss_seidel][determinism][periodicity]")
{
    const auto one = run_stirred(1);
    for (const int threads : {2, 3, 4}) {
        const auto many = run_stirred(threads);
        CAPTURE(threads);
        CHECK(same_bits(one.position, many.position));
        CHECK(same_bits(one.bodies, many.bodies));
    }
}

TEST_CASE("every thread count gives the same bits", "[gauss_seidel][determinism]")
{
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const auto one = run(1, stabilisation);
    for (const int threads : {2, 3, 4}) {
        const auto many = run(threads, stabilisation);
        CAPTURE(threads);
        CHECK(same_bits(one.position, many.position));
        CHECK(same_bits(one.bodies, many.bodies));
        CHECK(same_bits(one.id, many.id));
    }
}
