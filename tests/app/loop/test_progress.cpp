// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/progress.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using talus::Simulation;
using talus::StepReport;
using talus::StepWatch;

namespace
{

Simulation simulation()
{
    Simulation simulation;
    simulation.model.mean_diameter = simulation.model.min_diameter = 0.01;
    simulation.model.time_step = 1e-3;
    return simulation;
}

/// All that is said in so many steps that went like this one.
std::string said(StepWatch& watch, const StepReport& report, int steps)
{
    const Simulation made_them = simulation();
    std::string text;
    for (int k = 0; k < steps; ++k) text += watch.warning_after(report, made_them);
    return text;
}

} // namespace

TEST_CASE(
    "split steps are reported once, in the tenth, with what asked for it and a step that would do", "[app][watch]")
{
    StepWatch watch;
    StepReport fast;
    fast.sub_steps = 2;
    fast.split_for = {2.7, 4, 7, -1};
    CHECK(said(watch, StepReport(), 1000).empty());
    CHECK(said(watch, fast, 9).empty());
    // 0.1 d / 2.7 m/s, rounded down
    CHECK_THAT(said(watch, fast, 1), Contains("spheres 4 and 7") && Contains("--set time.step=0.00037"));
    CHECK(said(watch, fast, 1000).empty());
}

TEST_CASE("deep overlap is reported once where it lasts, with a step that makes contacts stiff enough", "[app][watch]")
{
    StepWatch watch;
    StepReport deep;
    deep.contacts.worst_overlap = 8e-4; // 8 % d
    CHECK(said(watch, deep, 199).empty());
    CHECK(said(watch, StepReport(), 1).empty()); // it has passed
    CHECK(said(watch, deep, 199).empty());
    CHECK_THAT(said(watch, deep, 1), Contains("8 % d") && Contains("--set time.step=0.0005")); // a quarter of it
    CHECK(said(watch, deep, 1000).empty());
}
