// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sieve_file.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/scene_error.hpp"
#include "tests/fuzz/fuzzed_file.hpp"
#include "tests/scenarios/small_scene.hpp"

/// Any bytes are either a sieve analysis, from which spheres can be drawn, or refused with a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        const auto analysis = talus::read_sieves(talus::fuzz::fuzzed_file("sieve.csv", bytes, size));
        auto scene = talus::test::small_scene();
        scene.fill[0].diameter.distribution = "sieve";
        scene.fill[0].diameter.sieve_sizes = analysis.sizes;
        scene.fill[0].diameter.sieve_passing = analysis.passing;
        talus::build_scene(scene);
    } catch (const talus::InputError&) {
    } catch (const talus::SceneError&) {
    }
    return 0;
}
