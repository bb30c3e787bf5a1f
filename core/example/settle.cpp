// SPDX-License-Identifier: GPL-3.0-or-later
// A column of ten beads settles on a floor, which then bears its weight.
#include <core/step/time_step.hpp>

#include <cmath>
#include <cstdio>

using namespace talus;

int main()
{
    constexpr double radius = 0.005; // m

    Model model;
    model.time_step = 2e-4; // s
    model.solver.tolerance = 1e-6;
    model.materials.list = {{"glass", 2500.0}};
    model.materials.laws = {{.friction = 0.5}};
    model.walls.push_back({.name = "floor", .shape = Plane{}});
    model.world = {Vec3(-1, -1, -1), Vec3(1, 1, 1)};
    model.physics = {.friction = true, .spin = true, .wall_loads = true};
    model.mean_diameter = model.min_diameter = model.max_diameter = 2 * radius;

    State state;
    for (int k = 0; k < 10; ++k)
        add_sphere(state, Vec3(0, 0, (2 * k + 1.1) * radius), radius, model.materials.list[0].density, 0);

    ContactNetwork network; // what a step hands on to the next
    StepReport report;
    while (state.time < 1.0) report = advance(state, network, model);

    double weight = 0.0; // N
    for (std::size_t i = 0; i < state.count(); ++i) weight -= state.mass(i) * model.gravity.z();
    const double force = -report.wall_loads.at(0).impulse.z() / model.time_step;
    std::printf("force on the floor: %.5f N; weight of the beads: %.5f N\n", force, weight);
    return std::abs(force / weight - 1.0) < 1e-3 ? 0 : 1;
}
