// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/slope.hpp"
#include "tests/support/sampling.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using talus::test::sample;

namespace
{

constexpr double diameter = 0.01;

/// A bed of spheres whose rows along x each lie lower by this much than the one before, with as many below them.
State stepped_bed(double drop)
{
    State state;
    for (int i = -20; i < 20; ++i)
        for (int j = 0; j < 5; ++j)
            for (int k = 0; k < 3; ++k)
                add_sphere(state, Vec3((i + 0.5) * diameter, (j + 0.5) * diameter, -drop * i - diameter * k),
                    0.5 * diameter, 2500.0, 0);
    return state;
}

Model model_of(const Vec3& gravity)
{
    Model model;
    model.gravity = gravity;
    model.mean_diameter = diameter;
    return model;
}

} // namespace

TEST_CASE("the slope of a bed is that of the tops of its rows, positive where it falls", "[slope]")
{
    const double degrees = GENERATE(-30.0, 0.0, 12.5, 40.0);
    const auto bed = stepped_bed(diameter * std::tan(degrees * std::numbers::pi / 180.0));
    const auto angle = [&](const Vec3& along, const Vec3& gravity, const Periodicity& periodicity = {}) {
        Slope sensor("slope", Vec3::Zero(), along, 0.2, {0.0, infinity});
        auto model = model_of(gravity);
        model.periodicity = periodicity;
        sample(sensor, bed, model);
        CHECK(sensor.latest()[0].name == "angle");
        CHECK(sensor.latest()[0].unit == "deg");
        return sensor.latest()[0].value;
    };
    CHECK(angle(Vec3::UnitX(), Vec3(0, 0, -9.81)) == Approx(degrees).margin(1e-9));
    CHECK(angle(-Vec3::UnitX(), Vec3(0, 0, -9.81)) == Approx(-degrees).margin(1e-9));
    // Down a chute that repeats itself along x gravity has a part along it, and up is at right angles to the chute.
    CHECK(angle(Vec3::UnitX(), Vec3(5, 0, -9.81), {Vec3(-0.2, 0, 0), Vec3(0.4, infinity, infinity)}) ==
          Approx(degrees).margin(1e-9));
}

TEST_CASE("spheres beside the measured part of a slope do not count", "[slope]")
{
    auto bed = stepped_bed(0.2 * diameter);
    add_sphere(bed, Vec3(0.11, 0.02, 1.0), 0.5 * diameter, 2500.0, 0);
    Slope sensor("slope", Vec3::Zero(), Vec3::UnitX(), 0.2, {0.0, infinity});
    sample(sensor, bed, model_of(Vec3(0, 0, -9.81)));
    CHECK(sensor.latest()[0].value == Approx(std::atan(0.2) * 180.0 / std::numbers::pi));
}

TEST_CASE("without spheres a slope has no angle", "[slope][degenerate]")
{
    Slope sensor("slope", Vec3::Zero(), Vec3::UnitX(), 0.2, {0.0, infinity});
    CHECK(std::isnan(sensor.latest()[0].value));
    sample(sensor, State{}, model_of(Vec3(0, 0, -9.81)));
    CHECK(std::isnan(sensor.latest()[0].value));
}
