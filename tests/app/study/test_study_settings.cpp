// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command_line.hpp"
#include "app/study/settings.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace talus;

namespace
{

scene::Study two_factors()
{
    scene::Study study;
    study.vary = {{"solver.stabilisation", {"matched", "projected"}}, {"solver.tolerance", {"draft", "fine"}},
        {"time.step", {"x0.5"}}};
    return study;
}

std::vector<std::string> names_of(const std::vector<Setting>& settings)
{
    std::vector<std::string> names;
    for (const Setting& setting : settings) names.push_back(setting.name);
    return names;
}

} // namespace

TEST_CASE("one key is varied at a time, with every value of the crossed ones", "[app][study]")
{
    const auto names = names_of(settings_of(two_factors(), 1e-3));
    CHECK(names == std::vector<std::string>{"reference", "default", "matched", "projected", "matched, tolerance=draft",
                       "matched, tolerance=fine", "projected, tolerance=draft", "projected, tolerance=fine",
                       "matched, step=x0.5", "projected, step=x0.5"});
}

TEST_CASE("a grid has every combination, and no cross only single changes", "[app][study]")
{
    auto study = two_factors();
    study.cross = {"all"};
    CHECK(names_of(settings_of(study, 1e-3)) ==
          std::vector<std::string>{"reference", "default", "matched, tolerance=draft, step=x0.5",
              "matched, tolerance=fine, step=x0.5", "projected, tolerance=draft, step=x0.5",
              "projected, tolerance=fine, step=x0.5"});
    study.cross = {};
    CHECK(names_of(settings_of(study, 1e-3)) == std::vector<std::string>{"reference", "default", "matched", "projected",
                                                    "tolerance=draft", "tolerance=fine", "step=x0.5"});
}

TEST_CASE("a step may be given as a multiple of the scene's", "[app][study]")
{
    auto study = two_factors();
    const auto settings = settings_of(study, 2e-3);
    CHECK(settings.back().overrides == std::vector<std::string>{"solver.stabilisation=projected", "time.step=0.001"});
    study.vary.back().values = {"xy"};
    CHECK_THROWS_AS(settings_of(study, 2e-3), UsageError);
    study.vary.back().values = {"x-1"};
    CHECK_THROWS_AS(settings_of(study, 2e-3), UsageError);
}
