// SPDX-License-Identifier: GPL-3.0-or-later
// All benchmarks of steps and their parts. report.py runs them and writes the page; by hand, for instance:
//   build/benchmark_step --benchmark_filter=sweeps/flow
// The first run makes the beds, which takes minutes. Only figures of one session can be compared.
#include "tests/benchmarks/measures.hpp"

#include <benchmark/benchmark.h>

#include <malloc.h>

namespace talus::bench
{
namespace
{

void machine(benchmark::State& run)
{
    std::vector<double> free;
    for (auto _ : run) free.push_back(free_processors());
    run.counters["free_processors"] = median(free);
}

void register_machine(const char* moment)
{
    register_triad(moment);
    benchmark::RegisterBenchmark((std::string("machine/") + moment).c_str(), machine)->Iterations(5);
}

} // namespace

double free_processors()
{
    constexpr double duration = 0.1;
    const double cpu = cpu_seconds(), wall = wall_seconds();
#pragma omp parallel num_threads(2)
    while (wall_seconds() - wall < duration) {}
    return (cpu_seconds() - cpu) / (wall_seconds() - wall);
}

bool two_are_free()
{
    return free_processors() > 1.8;
}

} // namespace talus::bench

int main(int argc, char** argv)
{
    // As the program does for itself (app/main.cpp): memory that a step frees stays with it.
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    // The triad at three moments, so that its figures are of the same machine as the others'.
    talus::bench::register_machine("first");
    talus::bench::register_sweeps();
    talus::bench::register_machine("middle");
    talus::bench::register_steps();
    talus::bench::register_files();
    talus::bench::register_machine("last");
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
