// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/quietness.hpp"
#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>

using namespace talus;
using namespace talus::test;

namespace
{

/// How far each sphere has moved, by rank [d].
std::vector<double> displacements(const Simulation& simulation, const std::vector<Vec3>& from)
{
    std::vector<double> moved;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const auto id = static_cast<std::size_t>(simulation.state.id[i]);
        moved.push_back((simulation.state.position[i] - from[id]).norm() / simulation.model.mean_diameter);
    }
    std::ranges::sort(moved);
    return moved;
}

} // namespace

TEST_CASE("a pile at rest from another program's file stays as it is", "[import][slow]")
{
    auto simulation = open_scene("import");
    const auto start = simulation.state.position; // in the order of ids
    run_until(simulation, 1e-6);                  // one step, with a sample of the angle
    const double angle = result(simulation, "heap", "angle").value;
    run_until(simulation, 0.8);
    const auto moved = displacements(simulation, start);
    double mean = 0.0;
    for (const double d : moved) mean += d / static_cast<double>(moved.size());
    const double change = result(simulation, "heap", "angle").value - angle;
    const auto quiet = watch(simulation, 0.2);
    std::printf("import: moved %.2g d on average, median %.2g, 99 %% %.2g, most %.2g; angle %.2f %+.2f degrees; creep "
                "%.2g d/s, overlap %.2g d\n",
        mean, moved[moved.size() / 2], moved[moved.size() * 99 / 100], moved.back(), angle, change, quiet.creep,
        quiet.overlap);
    CHECK(moved[moved.size() / 2] < 0.01);
    CHECK(std::abs(change) < 0.5);
    CHECK(quiet.creep < 1e-6);
}
