// SPDX-License-Identifier: GPL-3.0-or-later
// Heaps whose envelope is known: exact cones and pyramids, filled with grains.
#include "core/base/statistics.hpp"
#include "core/sensors/repose.hpp"
#include "core/world/closed_mesh.hpp"
#include "scenarios/builder/packing.hpp"
#include "tests/support/sampling.hpp"
#include "tests/support/world.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 0.006, degree = std::numbers::pi / 180.0;

/// What encloses a heap.
struct Envelope {
    Region region;
    double ball = 0.0; ///< radius of the largest ball in it [m]
};

double ball_in(double radius, double angle)
{
    return radius * std::tan(0.5 * angle * degree);
}

Envelope cone(double radius, double angle)
{
    Region region;
    region.shape = Region::Shape::cone;
    region.radius = radius;
    region.height = radius * std::tan(angle * degree);
    return {region, ball_in(radius, angle)};
}

/// A pyramid on a square, whose faces have this slope.
Envelope pyramid(double half_edge, double angle)
{
    const double a = half_edge;
    const std::vector<Vec3> corners = {
        {-a, -a, 0}, {a, -a, 0}, {a, a, 0}, {-a, a, 0}, {0, 0, a * std::tan(angle * degree)}};
    Region region;
    region.shape = Region::Shape::inside;
    region.surface = std::make_shared<ClosedMesh>(
        make_mesh(corners, {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}), 0.0);
    return {region, ball_in(a, angle)};
}

/// A dense packing; along the faces grains leave more room.
std::vector<PackedSphere> filled(const Envelope& heap, std::uint64_t seed)
{
    const Materials glass{{{.name = "glass", .density = 2500.0}}, {}};
    const Mixture beads{{Species{0, {.min = d, .max = d}}}};
    const Model model;
    const PackingRoom room(heap.region, {}, model);
    const double volume = heap.region.volume() * std::pow(1.0 - 0.2 * d / heap.ball, 3);
    GrainSource source(
        beads, glass, {.count = static_cast<std::int64_t>(0.6 * volume / (std::numbers::pi / 6 * d * d * d))});
    Random random(seed);
    return dense_packing(room, source, {}, random);
}

struct Look {
    double angle = 0.0; ///< [degree]
    std::string silence;
};

Look look_at(const Envelope& heap, std::uint64_t seed, double outer = 0.0)
{
    Model model;
    model.gravity = Vec3(0, 0, -9.81);
    model.mean_diameter = d;
    State state;
    for (const PackedSphere& one : filled(heap, seed)) add_sphere(state, one.center, one.radius, 2500.0, 0);
    Repose sensor("heap", Vec3::Zero(), 0.0, outer);
    sample(sensor, state, model);
    return {sensor.results().front().value, sensor.silence()};
}

MeanAndError angle_of(const Envelope& heap, double outer = 0.0)
{
    MeanAndError angles;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) angles.add(look_at(heap, seed, outer).angle);
    return angles;
}

} // namespace

TEST_CASE("a cone of grains has the angle of its envelope, from the smallest that has one on", "[repose]")
{
    const auto [radius, angle] = GENERATE(table<double, double>(
        {{8, 30}, {10, 30}, {10, 20}, {15, 20}, {15, 30}, {20, 15}, {20, 25}, {8, 40}, {12, 40}}));
    const MeanAndError found = angle_of(cone(radius * d, angle));
    INFO("R = " << radius << " d, " << angle << " degrees");
    REQUIRE(found.count() == 4);
    CHECK(found.mean() == Approx(angle).margin(1.0));
}

TEST_CASE("a large cone of grains has the angle of its envelope", "[repose][slow]")
{
    CHECK(angle_of(cone(40 * d, 30)).mean() == Approx(30).margin(0.3));
}

TEST_CASE("a cone of grains has its angle where only the outer radius is given", "[repose]")
{
    const double radius = GENERATE(10.0, 20.0);
    CHECK(angle_of(cone(radius * d, 30), 5.0 / 6 * radius * d).mean() == Approx(30).margin(1.0));
}

TEST_CASE("a pyramid of grains has the slope of its mean over the azimuth", "[repose]")
{
    // At a distance r from the axis, inside the base, the height is H (1 − r max(|cos φ|, |sin φ|) / a), φ the azimuth.
    const double a = GENERATE(8.0, 12.0), angle = 30;
    const double mean = std::atan(2 * std::numbers::sqrt2 / std::numbers::pi * std::tan(angle * degree)) / degree;
    INFO("half an edge of " << a << " d");
    CHECK(angle_of(pyramid(a * d, angle)).mean() == Approx(mean).margin(1.0));
}

TEST_CASE("a heap too small to be measured is refused with its reason", "[repose]")
{
    const Look low = look_at(cone(5 * d, 25), 1);
    CHECK(std::isnan(low.angle));
    CHECK(low.silence.find("diameters high") != std::string::npos);
    const Look narrow = look_at(cone(3 * d, 60), 1);
    CHECK(std::isnan(narrow.angle));
    CHECK(narrow.silence.find("its flank is") != std::string::npos);
}
