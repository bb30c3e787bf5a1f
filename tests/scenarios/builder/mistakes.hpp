// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/builder/build_scene.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <functional>

namespace talus::test
{

using S = scene::Scene;

/// A way to spoil the small scene, and what is said of it.
struct Mistake {
    std::function<void(S&)> make;
    std::string key, sentence;
};

/// The key and the sentence of the error that the scene makes.
inline std::pair<std::string, std::string> refusal_of(const S& scene)
{
    try {
        build_scene(scene);
    } catch (const SceneError& error) {
        return {error.key, error.what()};
    }
    return {"none", "no error"};
}

/// Each of these mistakes alone keeps the small scene from being built, with its key and sentence.
inline void check_all(const std::vector<Mistake>& mistakes)
{
    for (const Mistake& mistake : mistakes) {
        auto scene = small_scene();
        mistake.make(scene);
        INFO(mistake.key << ": " << mistake.sentence);
        const auto [key, sentence] = refusal_of(scene);
        CHECK(key == mistake.key);
        CHECK(sentence == mistake.sentence);
    }
}

} // namespace talus::test
