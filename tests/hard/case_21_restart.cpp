// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

/// All that changes in a run, as a checkpoint has it.
std::string stored(Simulation& simulation)
{
    Archive archive;
    simulation.persist(archive);
    return archive.bytes();
}

void put_back(Simulation& simulation, const std::string& bytes)
{
    Archive archive(bytes);
    simulation.persist(archive);
    REQUIRE(archive.at_end());
}

void run(Simulation& simulation, int steps)
{
    for (int k = 0; k < steps; ++k) {
        const auto report = advance(simulation);
        for (auto& sensor : simulation.sensors) sensor->watch(snapshot(simulation, report));
        if (simulation.state.steps % 20 == 0)
            for (auto& sensor : simulation.sensors) sensor->sample(snapshot(simulation, report));
    }
}

struct Scenario {
    std::string scene;
    int before, steps; ///< until the restart, and from there to the end
    std::vector<std::string> overrides;
};

} // namespace

TEST_CASE("21 restart", "[hard]")
{
    // A run that goes on from its checkpoint must not be told from one that never stopped: to the last bit, with its
    // candidate list, tiles, carried impulses, sources, random numbers and sensors. Restarts at odd steps of pouring,
    // of flow from a mesh hopper with an outlet, of a periodic drum that turns, and of a plate that is pressed down.
    HardCase hard("21 restart");
    const std::vector<Scenario> scenarios = {
        {"pile", 1777, 1777, {"pour.source.count=800"}},
        {"pile", 1777, 1777, {"pour.source.count=800", "solver.stabilisation=projected"}},
        {"hopper", 2501, 1500, {"fill.0.count=1500", "wall.gate.remove_at=0.4"}},
        {"drum", 2003, 2003, {"fill.0.count=1000"}},
        {"piston", 1501, 1501, {}},
    };
    for (const auto& [scene, before, steps, overrides] : scenarios) {
        auto whole = open_scene(scene, overrides);
        run(whole, before);
        const std::string checkpoint = stored(whole);
        run(whole, steps);
        const std::string end = stored(whole);

        auto continued = open_scene(scene, overrides);
        put_back(continued, checkpoint);
        run(continued, steps);
        const std::string law = overrides.size() > 1 ? overrides.back() : "";
        hard.holds(scene + " " + law + ": the same bits", stored(continued) == end);

        // The comparison sees a warm start that is lost: without its impulses the run ends elsewhere.
        auto cold = open_scene(scene, overrides);
        put_back(cold, checkpoint);
        cold.network = {};
        run(cold, steps);
        hard.holds(scene + " " + law + ": not without the warm start", stored(cold) != end);
    }
}
