// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_scene.hpp"

#include "io/scene/scene_file.hpp"
#include "scenarios/builder/build_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace talus::test
{

Simulation open_scene(const std::string& name, const std::vector<std::string>& overrides)
{
    const std::filesystem::path root = TALUS_SOURCE_DIR;
    for (const auto* folder : {"tests/hard/scenes", "tests/validation/scenes", "scenarios"}) {
        const auto file = root / folder / (name + ".toml");
        if (std::filesystem::exists(file)) return build_scene(read_scene(file, overrides).scene).simulation;
    }
    throw std::logic_error("no scene " + name);
}

double run_until(Simulation& simulation, double time)
{
    constexpr double sample_interval = 0.005;
    double next_sample = simulation.state.time, fastest = 0.0;
    const auto watch = [&](const StepReport& report) {
        REQUIRE(report.bodies.incidents.empty());
        fastest = std::max(fastest, report.bodies.fastest_speed);
        for (auto& sensor : simulation.sensors) sensor->watch(snapshot(simulation, report));
        if (simulation.state.time < next_sample) return;
        for (auto& sensor : simulation.sensors) sensor->sample(snapshot(simulation, report));
        next_sample += sample_interval;
    };
    talus::run_until(simulation, time, {.after_step = watch});
    return fastest;
}

Measurement result(const Simulation& simulation, const std::string& sensor, const std::string& quantity)
{
    for (const auto& s : simulation.sensors)
        for (const auto& m : s->results())
            if (s->name == sensor && m.name == quantity) return m;
    throw std::logic_error("no result " + sensor + " " + quantity);
}

} // namespace talus::test
