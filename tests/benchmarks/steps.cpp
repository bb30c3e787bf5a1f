// SPDX-License-Identifier: GPL-3.0-or-later
// Whole steps by phase, on one thread and on two; a search from nothing; the settled boxes W3.
#include "tests/benchmarks/beds.hpp"
#include "tests/benchmarks/measures.hpp"

#include "core/step/diagnostics.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <utility>

namespace talus::bench
{
namespace
{

constexpr std::array<const char*, 6> phases = {"search", "assembly", "warm_start", "sweeps", "positions", "report"};

/// Seconds and counts of steps.
struct Tally {
    double wall = 0.0, cpu = 0.0;
    std::array<double, phases.size()> phase_wall{}, phase_cpu{};
    double steps = 0.0, sweeps = 0.0, candidates = 0.0, contacts = 0.0, updates = 0.0, sphere_steps = 0.0;
};

/// Makes steps and adds them up.
void make_steps(Simulation& simulation, int count, Tally& tally)
{
    const double wall = wall_seconds(), cpu = cpu_seconds();
    double last_wall = wall, last_cpu = cpu;
    auto phase = static_cast<std::size_t>(Phase::report); // sources and outlets, before the search begins
    const PhaseObserver clock = [&](Phase next) {
        const double now_wall = wall_seconds(), now_cpu = cpu_seconds();
        tally.phase_wall[phase] += now_wall - std::exchange(last_wall, now_wall);
        tally.phase_cpu[phase] += now_cpu - std::exchange(last_cpu, now_cpu);
        phase = static_cast<std::size_t>(next);
    };
    for (int k = 0; k < count; ++k) {
        const auto report = advance(simulation, clock);
        const auto contacts = static_cast<double>(report.contacts.count);
        tally.candidates += static_cast<double>(report.search.candidates);
        tally.contacts += contacts;
        tally.sweeps += report.solve.sweeps;
        tally.updates += contacts * report.solve.sweeps;
        tally.sphere_steps += static_cast<double>(simulation.state.count());
    }
    clock(Phase::report);
    tally.steps += count;
    tally.wall += last_wall - wall;
    tally.cpu += last_cpu - cpu;
}

/// Steps in blocks, on one thread and, where two processors are free, on two in turn. The share of a phase is of CPU
/// seconds on one thread and of the clock on two.
void steps(benchmark::State& run, const std::string& bed, int in_a_block)
{
    auto simulation = open_bed(bed);
    const std::size_t most_threads = two_are_free() ? 2 : 1;
    std::array<Tally, 2> tallies;
    std::vector<double> gains;
    for (auto _ : run) {
        std::array<double, 2> wall{};
        for (std::size_t threads = 1; threads <= most_threads; ++threads) {
            omp_set_num_threads(static_cast<int>(threads));
            Tally& tally = tallies[threads - 1];
            const double before = tally.wall;
            make_steps(simulation, in_a_block, tally);
            wall[threads - 1] = tally.wall - before;
        }
        gains.push_back(wall[0] / wall[1]);
        run.SetIterationTime(wall[0] / in_a_block);
    }
    const auto& [one, two] = tallies;
    run.counters["spheres"] = one.sphere_steps / one.steps;
    run.counters["candidates"] = one.candidates / one.steps;
    run.counters["contacts"] = one.contacts / one.steps;
    run.counters["sweeps_a_step"] = one.sweeps / one.steps;
    run.counters["step_ms"] = 1e3 * one.cpu / one.steps;
    run.counters["ns_sphere_step"] = 1e9 * one.cpu / one.sphere_steps;
    run.counters["assembly_ns_contact"] = 1e9 * one.phase_cpu[static_cast<std::size_t>(Phase::assembly)] / one.contacts;
    run.counters["Mupdates_s"] = 1e-6 * one.updates / one.phase_cpu[static_cast<std::size_t>(Phase::sweeps)];
    for (std::size_t k = 0; k < phases.size(); ++k) run.counters[phases[k]] = one.phase_cpu[k] / one.cpu;
    if (most_threads == 1) return;
    run.counters["step_ms_two_threads"] = 1e3 * two.wall / two.steps;
    run.counters["gain_of_two_threads"] = median(gains);
    for (std::size_t k = 0; k < phases.size(); ++k)
        run.counters[std::string(phases[k]) + "_two_threads"] = two.phase_wall[k] / two.wall;
}

/// Lists all pairs anew, as the first step does.
void search_from_nothing(benchmark::State& run, const std::string& bed)
{
    auto simulation = open_bed(bed);
    omp_set_num_threads(1);
    std::vector<double> seconds;
    std::size_t candidates = 0;
    for (auto _ : run) {
        simulation.network = {};
        double begin = 0.0, end = 0.0;
        const auto prepared = prepare_step(simulation.state, simulation.network, simulation.model,
            {simulation.model.time_step}, [&](Phase phase) { (phase == Phase::search ? begin : end) = cpu_seconds(); });
        candidates = prepared.search.candidates;
        seconds.push_back(end - begin);
        run.SetIterationTime(seconds.back());
    }
    const auto spheres = static_cast<double>(simulation.state.count());
    run.counters["spheres"] = spheres;
    run.counters["candidates"] = static_cast<double>(candidates);
    run.counters["ns_sphere"] = 1e9 * median(seconds) / spheres;
}

/// A settled box for a second more, with 50 sweeps in each step of 1 ms, as the peers had it.
void settled_box(benchmark::State& run, const std::string& bed)
{
    auto simulation = open_bed(bed, [](scene::Scene& scene) {
        scene.time.step = {1e-3, ""};
        scene.solver.min_sweeps = scene.solver.max_sweeps = 50;
    });
    omp_set_num_threads(1);
    Tally tally;
    for (auto _ : run) {
        make_steps(simulation, 1000, tally);
        run.SetIterationTime(tally.cpu);
    }
    run.counters["spheres"] = static_cast<double>(simulation.state.count());
    run.counters["contacts"] = tally.contacts / tally.steps;
    run.counters["sweeps_a_step"] = tally.sweeps / tally.steps;
    run.counters["step_ms"] = 1e3 * tally.cpu / tally.steps;
    run.counters["Mupdates_s"] = 1e-6 * tally.updates / tally.phase_cpu[static_cast<std::size_t>(Phase::sweeps)];
    run.counters["kinetic_energy_J"] = kinetic_energy(simulation.state);
}

template <class Function>
benchmark::internal::Benchmark* add(const std::string& name, int iterations, Function function)
{
    return benchmark::RegisterBenchmark(name.c_str(), function)
        ->Iterations(iterations)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

} // namespace

void register_steps()
{
    const auto add_steps = [](const std::string& bed, int in_a_block) {
        add("steps/" + bed, 5, [=](benchmark::State& run) { steps(run, bed, in_a_block); });
    };
    for (const std::string scene : {"hopper", "silo", "pile", "drum", "packing"}) add_steps(scene, 100);
    for (const std::string kind : {"rest", "flow", "drum", "wide"}) {
        add_steps(kind + "_4k", 200);
        add_steps(kind + "_32k", 30);
        add_steps(kind + "_250k", 6);
        add_steps(kind + "_1M", 3);
    }
    for (const std::string size : {"4k", "32k", "250k", "1M"})
        add("search/flow_" + size, 3, [=](benchmark::State& run) { search_from_nothing(run, "flow_" + size); });
    for (const std::string bed : {"w3_5000", "w3_20000"})
        add("settled/" + bed, 1, [=](benchmark::State& run) { settled_box(run, bed); });
}

} // namespace talus::bench
