// SPDX-License-Identifier: GPL-3.0-or-later
// Seconds per step of beds at rest and of a discharging silo. Compare two builds by the ratio of figures of one
// session:
//   build/benchmark_step --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include "scenarios/build/build_scene.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>

using namespace talus;

namespace
{

/// Spheres dropped into a flat-bottomed silo of the proportions of scenarios/silo.toml; its gate opens at gate_opens.
scene::Scene silo(std::int64_t count, double gate_opens)
{
    scene::Scene scene;
    const double radius = 0.1 * std::cbrt(static_cast<double>(count) / 10000.0);
    scene.materials = {{"glass", 2500.0}};
    scene.contact = {{.between = {"glass", "glass"}, .friction = 0.5, .restitution = 0.5}};
    scene::FillTable fill;
    fill.material = "glass";
    fill.count = count;
    fill.diameter.distribution = "uniform";
    fill.diameter.min = 0.0095;
    fill.diameter.max = 0.0105;
    fill.region.shape = "cylinder";
    fill.region.base = Vec3(0, 0, 0.001);
    fill.region.radius = radius;
    fill.region.height = 10.0 * radius;
    scene.fill = {fill};
    const auto wall = [](const char* name, const char* shape, double wall_radius) {
        scene::WallTable table;
        table.name = name;
        table.shape = shape;
        table.material = "glass";
        table.radius = wall_radius;
        return table;
    };
    auto tube = wall("tube", "cylinder", radius), bottom = wall("bottom", "disk", radius),
         gate = wall("gate", "disk", 0.037);
    tube.height = 11.0 * radius;
    bottom.hole_radius = 0.035;
    gate.remove_at = gate_opens;
    scene.wall = {tube, bottom, gate};
    scene.outlet.resize(1);
    scene.outlet[0].region.min = Vec3(-1, -1, -0.4);
    scene.outlet[0].region.max = Vec3(1, 1, -0.2);
    return scene;
}

/// Runs steps one by one and reports contact updates a second and the share of each phase.
void run_steps(benchmark::State& run, Simulation& simulation)
{
    constexpr std::array<const char*, 6> names = {"search", "assembly", "warm_start", "sweeps", "positions", "report"};
    std::array<double, names.size()> seconds{};
    double updates = 0.0, sweeps = 0.0;
    auto last = std::chrono::steady_clock::now();
    auto phase = Phase::report;
    const PhaseObserver clock = [&](Phase next) {
        const auto now = std::chrono::steady_clock::now();
        seconds[static_cast<std::size_t>(phase)] += std::chrono::duration<double>(now - last).count();
        last = now;
        phase = next;
    };
    for (auto _ : run) {
        const auto report = advance(simulation, clock);
        updates += static_cast<double>(report.solve.sweeps) * static_cast<double>(report.contacts.count);
        sweeps += report.solve.sweeps;
    }
    clock(Phase::report);
    double all = 0.0;
    for (const double s : seconds) all += s;
    for (std::size_t k = 0; k < names.size(); ++k)
        run.counters[std::string(names[k]) + "_%"] = 100.0 * seconds[k] / all;
    run.counters["sweeps"] = sweeps / static_cast<double>(run.iterations());
    run.counters["Mupdates/s"] = 1e-6 * updates / seconds[static_cast<std::size_t>(Phase::sweeps)];
}

void bed_at_rest(benchmark::State& run)
{
    auto simulation = build_scene(silo(run.range(0), infinity)).simulation;
    while (simulation.state.time < 0.4) advance(simulation);
    run_steps(run, simulation);
}

void discharge(benchmark::State& run)
{
    auto simulation = build_scene(silo(run.range(0), 0.3)).simulation;
    while (simulation.state.time < 0.5) advance(simulation);
    run_steps(run, simulation);
}

/// A discharge with as much physics as its name says: what leaving out the rest is worth.
void discharge_with(benchmark::State& run, double friction, bool rotation)
{
    auto scene = silo(10000, 0.3);
    scene.contact[0].friction = friction;
    scene.world.rotation = rotation;
    auto simulation = build_scene(scene).simulation;
    while (simulation.state.time < 0.5) advance(simulation);
    run_steps(run, simulation);
}

} // namespace

BENCHMARK_CAPTURE(discharge_with, friction_and_rotation, 0.5, true)
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(discharge_with, friction_alone, 0.5, false)
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(discharge_with, neither, 0.0, true)
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(bed_at_rest)
    ->Arg(2000)
    ->Arg(10000)
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(discharge)
    ->Arg(2000)
    ->Arg(10000)
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_MAIN();
