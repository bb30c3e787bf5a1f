// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/stl.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/scene_error.hpp"
#include "tests/fuzz/fuzzed_file.hpp"
#include "tests/scenarios/small_scene.hpp"

/// Any bytes are either a mesh, which can be a wall near spheres, or refused with a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        auto soup = talus::read_stl(talus::fuzz::fuzzed_file("wall.stl", bytes, size));
        auto scene = talus::test::small_scene();
        talus::scene::WallTable wall;
        wall.name = "mesh";
        wall.material = "glass";
        wall.shape = "mesh";
        wall.vertices = std::move(soup.vertices);
        wall.triangles = std::move(soup.triangles);
        scene.wall.push_back(wall);
        auto simulation = talus::build_scene(scene).simulation;
        for (int k = 0; k < 3 && talus::advance(simulation).bodies.incidents.empty(); ++k) {}
    } catch (const talus::InputError&) {
    } catch (const talus::SceneError&) {
    }
    return 0;
}
