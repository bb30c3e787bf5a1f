// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/sphere_track.hpp"
#include "tests/support/sampling.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using talus::test::sample;

TEST_CASE("a sphere is followed by its id, and missed where it is not there", "[sphere_track]")
{
    Model model;
    State state;
    for (int k = 0; k < 3; ++k) add_sphere(state, Vec3(k, 2, 3), 0.5, 2500.0, 0, Vec3(4, 5, k), Vec3(7, 8, k));
    renumber_spheres(state, {2, 0, 1}, 3);
    SphereTrack sensor("ball", 2);
    sample(sensor, state, model);
    const std::vector<double> expected = {2, 2, 3, 4, 5, 2, 7, 8, 2};
    const auto all = sensor.results();
    for (std::size_t k = 0; k < expected.size(); ++k) CHECK(all[k].value == Approx(expected[k]));
    CHECK(all[0].name == "position_x");
    CHECK(all[8].unit == "rad/s");

    SphereTrack other("ball", 7);
    sample(other, state, model);
    CHECK(std::isnan(other.results()[0].value));
    CHECK(other.silence() == "sphere 7 is not there");
}
