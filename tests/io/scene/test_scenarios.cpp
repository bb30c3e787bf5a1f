// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace talus;
using namespace talus::test;

namespace
{

std::set<std::filesystem::path> supplied_scenes()
{
    std::set<std::filesystem::path> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(TALUS_SOURCE_DIR) / "scenarios"))
        if (entry.path().extension() == ".toml") scenes.insert(entry.path());
    return scenes;
}

} // namespace

TEST_CASE("every scene in scenarios/ builds and runs ten steps", "[scenarios]")
{
    REQUIRE(supplied_scenes().size() >= 5);
    for (const auto& path : supplied_scenes()) {
        DYNAMIC_SECTION(path.stem().string())
        {
            auto simulation = build_scene(read_scene(path).scene).simulation;
            // Places with six digits, as files of other programs have them, overlap by a little.
            const bool imported = path.stem() == "import";
            CHECK(check_overlaps(simulation).worst <= (imported ? 1e-3 * simulation.model.mean_diameter : 0.0));
            for (int k = 0; k < 10; ++k) CHECK(advance(simulation).bodies.incidents.empty());
            CHECK(simulation.state.steps == 10);
            CHECK(simulation.state.count() > 0);
        }
    }
}

TEST_CASE("the resolved scene of every scene in scenarios/ reads back to itself", "[scenarios][scene_file]")
{
    const SceneFolder folder;
    for (const auto& path : supplied_scenes()) {
        const std::string resolved = resolved_scene(read_scene(path).scene);
        CHECK(resolved_scene(read_scene(folder.write("again.toml", resolved)).scene) == resolved);
    }
}
