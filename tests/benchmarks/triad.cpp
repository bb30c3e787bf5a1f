// SPDX-License-Identifier: GPL-3.0-or-later
// a = b + 3 c over arrays that no cache holds, as STREAM has it: what the memory gives, to compare the sweeps with.
#include "tests/benchmarks/measures.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace talus::bench
{
namespace
{

void triad(benchmark::State& run)
{
    constexpr std::int64_t size = 16 << 20;
    constexpr double bytes = 3.0 * sizeof(double) * size; // as STREAM counts: read two, write one
    const int threads = static_cast<int>(run.range(0));
    std::vector<double> a(size, 1.0), b(size, 2.0), c(size, 3.0);
    std::vector<double> rates;
    for (auto _ : run) {
        const double cpu = cpu_seconds(), wall = wall_seconds();
#pragma omp parallel for schedule(static) num_threads(threads)
        for (std::int64_t i = 0; i < size; ++i) a[i] = b[i] + 3.0 * c[i];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
        const double seconds = threads == 1 ? cpu_seconds() - cpu : wall_seconds() - wall;
        run.SetIterationTime(seconds);
        rates.push_back(1e-9 * bytes / seconds);
    }
    run.counters["GB_s"] = median(rates);
}

} // namespace

void register_triad(const char* moment)
{
    benchmark::RegisterBenchmark((std::string("triad/") + moment).c_str(), triad)
        ->Arg(1)
        ->Arg(2)
        ->Iterations(15)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

} // namespace talus::bench
