// SPDX-License-Identifier: GPL-3.0-or-later
// Angle of repose of the peers' pile, with their geometry and their fit.
#include "run_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

TEST_CASE("a pile of spheres without rolling resistance rests at 22 degrees", "[repose][slow]")
{
    // LAMMPS 22.1, LIGGGHTS 22.0; steady shear of such spheres has 20.9 degrees (Chialvo, Sun & Sundaresan 2012).
    auto s = open_scene("funnel_pile");
    run_until(s, 5.0);
    const auto angle = result(s, "heap", "angle");
    WARN("without rolling resistance: " << angle.value << " +- " << angle.spread << " degrees, " << s.outflow.count
                                        << " spilt");
    CHECK(angle.value == Approx(22.0).margin(2.0));
}

TEST_CASE("rolling resistance of 0.1 makes the pile rest at 26 to 29 degrees", "[repose][slow]")
{
    // LAMMPS 26.8 (sds), LIGGGHTS 28.1 (epsd2).
    auto s = open_scene("funnel_pile", {"contact.glass-glass.rolling_friction=0.1"});
    run_until(s, 5.0);
    const auto angle = result(s, "heap", "angle");
    WARN("rolling resistance 0.1: " << angle.value << " +- " << angle.spread << " degrees, " << s.outflow.count
                                    << " spilt");
    CHECK(angle.value >= 26.0);
    CHECK(angle.value <= 29.0);
}
