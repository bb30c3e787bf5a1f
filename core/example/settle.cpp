// SPDX-License-Identifier: GPL-3.0-or-later
// A column of ten beads settles on a floor, which then bears its weight.
#include <core/simulation/simulation.hpp>

#include <cmath>
#include <cstdio>

using namespace talus;

int main()
{
    Simulation simulation;
    Model& model = simulation.model;
    model.time_step = 2e-4; // s
    model.materials = {{{"glass", 2500.0}}, {{.friction = 0.5}}};
    model.walls = {{.name = "floor", .shape = Plane{}}};
    model.world = {Vec3(-1, -1, -1), Vec3(1, 1, 1)};
    model.physics.wall_loads = true;
    for (int k = 0; k < 10; ++k) add_sphere(simulation.state, Vec3(0, 0, 0.005 * (2 * k + 1.1)), 0.005, 2500.0, 0);
    complete(simulation);
    const StepReport report = run_until(simulation, 1.0, {});

    double weight = 0.0; // N
    for (std::size_t i = 0; i < 10; ++i) weight -= simulation.state.mass(i) * model.gravity.z();
    const double force = -report.wall_loads.at(0).impulse.z() / model.time_step;
    std::printf("force on the floor: %.5f N; weight of the beads: %.5f N\n", force, weight);
    return std::abs(force / weight - 1.0) < 1e-3 ? 0 : 1;
}
