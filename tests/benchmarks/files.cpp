// SPDX-License-Identifier: GPL-3.0-or-later
// Frames and checkpoints: megabytes a second.
#include "tests/benchmarks/beds.hpp"
#include "tests/benchmarks/measures.hpp"

#include "core/base/archive.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/frames.hpp"

#include <benchmark/benchmark.h>

#include <filesystem>

namespace talus::bench
{
namespace
{

namespace fs = std::filesystem;

double megabytes_in(const fs::path& folder)
{
    double bytes = 0.0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
    return 1e-6 * bytes;
}

/// Calls `write` in an empty folder each time. Seconds are of the processor: a disk would be another benchmark.
template <class Write> void time_writing(benchmark::State& run, const Simulation& simulation, Write write)
{
    const fs::path folder = fs::path(TALUS_BEDS_FOLDER) / "written";
    std::vector<double> rates;
    double megabytes = 0.0;
    for (auto _ : run) {
        fs::remove_all(folder);
        fs::create_directories(folder);
        const double begin = cpu_seconds();
        write(folder);
        const double seconds = cpu_seconds() - begin;
        megabytes = megabytes_in(folder);
        rates.push_back(megabytes / seconds);
        run.SetIterationTime(seconds);
    }
    fs::remove_all(folder);
    run.counters["B_sphere"] = 1e6 * megabytes / static_cast<double>(simulation.state.count());
    run.counters["MB_s"] = median(rates);
}

void particle_frame(benchmark::State& run, const std::string& bed)
{
    const auto simulation = open_bed(bed);
    time_writing(run, simulation, [&](const fs::path& folder) { FrameWriter(folder).write_particles(simulation); });
}

void contact_frame(benchmark::State& run, const std::string& bed)
{
    const auto simulation = open_bed(bed);
    time_writing(run, simulation, [&](const fs::path& folder) { FrameWriter(folder).write_contacts(simulation); });
}

void checkpoint(benchmark::State& run, const std::string& bed)
{
    auto simulation = open_bed(bed);
    time_writing(run, simulation, [&](const fs::path& folder) {
        Archive archive;
        archive(simulation);
        write_checkpoint(folder, "benchmark", archive.bytes());
    });
}

void resume(benchmark::State& run, const std::string& bed)
{
    auto simulation = open_bed(bed);
    Archive stored;
    stored(simulation);
    const fs::path folder = fs::path(TALUS_BEDS_FOLDER) / "written";
    fs::create_directories(folder);
    write_checkpoint(folder, "benchmark", stored.bytes());
    std::vector<double> rates;
    for (auto _ : run) {
        const double begin = cpu_seconds();
        Archive archive(read_checkpoint(folder, "benchmark").state);
        archive(simulation);
        const double seconds = cpu_seconds() - begin;
        rates.push_back(1e-6 * static_cast<double>(stored.bytes().size()) / seconds);
        run.SetIterationTime(seconds);
    }
    fs::remove_all(folder);
    run.counters["B_sphere"] =
        static_cast<double>(stored.bytes().size()) / static_cast<double>(simulation.state.count());
    run.counters["MB_s"] = median(rates);
}

} // namespace

void register_files()
{
    const auto add = [](const char* what, void (*function)(benchmark::State&, const std::string&)) {
        for (const std::string bed : {"flow_32k", "flow_250k"})
            benchmark::RegisterBenchmark(
                (std::string("files/") + what + "/" + bed).c_str(), [=](benchmark::State& run) { function(run, bed); })
                ->Iterations(5)
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
    };
    add("particle_frame", particle_frame);
    add("contact_frame", contact_frame);
    add("checkpoint", checkpoint);
    add("resume", resume);
}

} // namespace talus::bench
