// SPDX-License-Identifier: GPL-3.0-or-later
// The sweeps alone, on the contacts of real beds: contact updates a second, on one thread and on two.
#include "tests/benchmarks/beds.hpp"
#include "tests/benchmarks/measures.hpp"

#include "core/solver/gauss_seidel.hpp"
#include "core/solver/piston_group.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace talus::bench
{
namespace
{

constexpr int sweeps_in_a_row = 10;

/// The problem of a step, after its warm start.
struct Problem {
    Simulation simulation;
    ContactNetwork network;   ///< as it is before the sweeps
    std::vector<Body> bodies; ///< likewise
    std::size_t contacts = 0;
};

Problem make_problem(const std::string& bed, const Change& change)
{
    Problem problem;
    problem.simulation = open_bed(bed, change);
    auto [model, state, network] =
        std::tie(problem.simulation.model, problem.simulation.state, problem.simulation.network);
    problem.contacts = prepare_step(problem.simulation).contacts.count;
    PistonGroup pistons(network, state, model, model.time_step);
    for (Body& body : state.bodies) body.velocity += model.time_step * model.gravity;
    apply_warm_start(network, pistons, state.bodies, model.physics);
    problem.network = network;
    problem.bodies = state.bodies;
    return problem;
}

/// The least that a sweep moves for a contact with all numbers in double [B]. A contact has two indices, the normal,
/// the target and three constants, and its impulse is read and written; with friction two more components and three
/// more constants, with rolling another impulse and two constants; a moving wall has two vectors, but contacts with
/// walls are few. Each sphere's cache line is read and written once in a sweep.
double bytes_of_update(const ModelledPhysics& physics, double contacts, double spheres)
{
    constexpr double number = sizeof(double), line = 64.0;
    double bytes = 2 * sizeof(std::int32_t) + (3 + 1 + 3 + 2) * number;
    if (physics.friction) bytes += (2 * 2 + 3) * number;
    if (physics.rolling) bytes += (2 * 3 + 2) * number;
    return bytes + 2.0 * line * spheres / contacts;
}

/// Ten sweeps at a time, each time from the same beginning, so that what converges is the same. Threads in turn.
void sweeps(benchmark::State& run, const std::string& bed, const Change& change)
{
    Problem problem = make_problem(bed, change);
    const Model& model = problem.simulation.model;
    State& state = problem.simulation.state;
    ContactNetwork& network = problem.simulation.network;
    PistonGroup pistons(network, state, model, model.time_step);
    const double updates = sweeps_in_a_row * static_cast<double>(problem.contacts);
    const int most_threads = two_are_free() ? 2 : 1;
    std::array<std::vector<double>, 2> rates;
    for (auto _ : run) {
        for (int threads = 1; threads <= most_threads; ++threads) {
            network = problem.network;
            state.bodies = problem.bodies;
            omp_set_num_threads(threads);
            const double cpu = cpu_seconds(), wall = wall_seconds();
            sweep_contacts(sweeps_in_a_row, network, pistons, state.bodies, model.physics);
            const double seconds = threads == 1 ? cpu_seconds() - cpu : wall_seconds() - wall;
            rates[static_cast<std::size_t>(threads - 1)].push_back(1e-6 * updates / seconds);
            if (threads == 1) run.SetIterationTime(seconds);
        }
    }
    const auto spheres = static_cast<double>(state.count()), contacts = static_cast<double>(problem.contacts);
    run.counters["spheres"] = spheres;
    run.counters["contacts"] = contacts;
    run.counters["Mupdates_s"] = median(rates[0]);
    if (most_threads > 1) run.counters["Mupdates_s_two_threads"] = median(rates[1]);
    run.counters["bytes"] = bytes_of_update(model.physics, contacts, spheres);
}

void add(const std::string& bed, int iterations, const std::string& variant = "as_is", const Change& change = {})
{
    benchmark::RegisterBenchmark(
        ("sweeps/" + bed + "/" + variant).c_str(), [=](benchmark::State& run) { sweeps(run, bed, change); })
        ->Iterations(iterations)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

/// What a scene may model, on the same bed.
void add_variants(const std::string& bed, int iterations)
{
    add(bed, iterations, "no_rotation", [](scene::Scene& scene) { scene.world.rotation = false; });
    add(bed, iterations, "rolling", [](scene::Scene& scene) { scene.contact[0].rolling_friction = 0.1; });
    add(bed, iterations, "moving_walls", [](scene::Scene& scene) {
        scene::MotionTable shaking;
        shaking.kind = "shake";
        shaking.amplitude = 1e-6 * Vec3::UnitX();
        shaking.frequency = 10.0;
        scene.wall[0].motion = {shaking};
    });
    add(bed, iterations, "projected", [](scene::Scene& scene) { scene.solver.stabilisation = "projected"; });
}

} // namespace

void register_sweeps()
{
    add("silo", 40);
    add_variants("silo", 40);
    for (const std::string kind : {"rest", "flow", "drum", "wide"}) {
        add(kind + "_4k", 60);
        add(kind + "_32k", 15);
        add(kind + "_250k", 5);
        add(kind + "_1M", 3);
    }
    add("smooth_4k", 60); // a bed that has lost its friction has lost most of its contacts, too
    add("smooth_32k", 15);
    add_variants("rest_32k", 15);
}

} // namespace talus::bench
