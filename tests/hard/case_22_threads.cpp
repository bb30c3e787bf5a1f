// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <omp.h>

using namespace talus;
using namespace talus::test;

namespace
{

/// All that has come of a scene after some steps with this number of threads.
std::string run(int threads, const std::string& scene, int steps, const std::vector<std::string>& overrides)
{
    const int usual = omp_get_max_threads();
    omp_set_num_threads(threads);
    auto simulation = open_scene(scene, overrides);
    for (int k = 0; k < steps; ++k) advance(simulation);
    int team = 0;
#pragma omp parallel
#pragma omp single
    team = omp_get_num_threads();
    omp_set_num_threads(usual);
    REQUIRE(team == threads);
    Archive archive;
    simulation.persist(archive);
    return archive.bytes();
}

} // namespace

TEST_CASE("22 thread counts", "[hard]")
{
    // With locks or atomic sums the order of the threads shows in the last bits, and a thousand steps later everywhere.
    HardCase hard("22 thread counts");
    struct Scenario {
        std::string scene;
        int steps;
        std::vector<std::string> overrides;
    };
    const std::vector<Scenario> scenarios = {
        {"hopper", 1000, {"fill.0.count=3000", "wall.gate.remove_at=0.15"}},
        {"hopper", 1000, {"fill.0.count=3000", "wall.gate.remove_at=0.15", "solver.stabilisation=projected"}},
        {"hopper", 1000,
            {"fill.0.count=3000", "wall.gate.remove_at=0.15", "solver.stabilisation=projected",
                "solver.pressure_scaling=true"}},
        {"drum", 1000, {"fill.0.count=2000"}},
    };
    for (const auto& [scene, steps, overrides] : scenarios) {
        const std::string one = run(1, scene, steps, overrides);
        for (const int threads : {2, 4, 8, 16})
            hard.holds(scene +
                           (overrides.size() > 3      ? ", projected and scaled: "
                               : overrides.size() > 2 ? ", projected: "
                                                      : ": ") +
                           std::to_string(threads) + " threads, the bits of one",
                run(threads, scene, steps, overrides) == one);
    }
}
