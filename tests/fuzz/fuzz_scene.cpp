// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/scene_error.hpp"
#include "tests/fuzz/fuzzed_file.hpp"

#include <algorithm>

namespace
{

constexpr std::int64_t most_spheres = 1000; ///< more may rightly take more time and memory than a fuzz test has

bool is_small(const talus::scene::Scene& scene)
{
    return std::ranges::all_of(scene.fill, [](const auto& fill) { return fill.count <= most_spheres; });
}

} // namespace

/// Any bytes are either a scene, of which a step can be made, or refused with a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        const auto file = talus::read_scene(talus::fuzz::fuzzed_file("scene.toml", bytes, size));
        if (!is_small(file.scene)) return 0;
        auto simulation = talus::build_scene(file.scene).simulation;
        talus::advance(simulation);
    } catch (const talus::InputError&) {
    } catch (const talus::SceneError&) {
    }
    return 0;
}
