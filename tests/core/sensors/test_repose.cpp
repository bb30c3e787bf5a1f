// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/repose.hpp"
#include "tests/support/sampling.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using talus::test::sample;

namespace
{

constexpr double degree = std::numbers::pi / 180.0;
constexpr double diameter = 0.01;

/// A heap of this surface (height over radius and azimuth), dense with spheres whose tops lie on it or below.
struct Heap {
    Model model;
    State state;
    Vec3 base = Vec3(0.3, -0.2, 0.1);

    explicit Heap(const std::function<double(double, double)>& surface, double radius = 0.3, double noise = 0.0,
        const Vec3& up = Vec3::UnitZ())
    {
        model.gravity = -9.81 * up;
        model.mean_diameter = diameter;
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), up);
        Random random(1);
        const int count = static_cast<int>(80.0 * radius * radius / (diameter * diameter));
        for (int k = 0; k < count; ++k) {
            const double r = radius * std::sqrt(uniform(random)), azimuth = 2 * std::numbers::pi * uniform(random);
            const double top = surface(r, azimuth) - noise * uniform(random);
            if (top <= 0.0) continue;
            const Vec3 x(r * std::cos(azimuth), r * std::sin(azimuth), top - 0.5 * diameter);
            add_sphere(state, base + turn * x, 0.5 * diameter, 2500.0, 0);
            if (k % 3 == 0) // and one inside, which must not count
                add_sphere(state, base + turn * Vec3(x[0], x[1], 0.5 * x[2]), 0.5 * diameter, 2500.0, 0);
        }
    }

    Measurement angle(double inner = 0.0, double outer = 0.0) const
    {
        Repose sensor("heap", base, inner, outer);
        sample(sensor, state, model);
        return sensor.results()[0];
    }
};

auto cone(double angle, double apex)
{
    return [=](double r, double) { return apex - r * std::tan(angle * degree); };
}

} // namespace

TEST_CASE("the angle of an exact cone is its angle", "[repose]")
{
    const double angle = GENERATE(10.0, 25.0, 35.0);
    const Heap heap(cone(angle, 0.1));
    const auto measured = heap.angle();
    CHECK(measured.name == "angle");
    CHECK(measured.unit == "deg");
    // The highest of the spheres in a ring's sector lies near its inner rim, by chance more or less so.
    CHECK(measured.value == Approx(angle).margin(0.3));
    CHECK(measured.spread < 0.3);
    CHECK(measured.spread >= 0.0);
}

TEST_CASE("the angle does not depend on which way is down", "[repose]")
{
    const Vec3 up = GENERATE(Vec3(-1, 0, 0), Vec3(0, 0, -1), Vec3(2, -1, 2) / 3.0);
    CHECK(Heap(cone(25.0, 0.1), 0.3, 0.0, up).angle().value == Approx(25.0).margin(0.3));
}

TEST_CASE("a heap with a blunt tip and a thin skirt has the angle of its flank", "[repose]")
{
    // A flank of 25 degrees between 85 and 15 % of the height, a rounded tip, and a skirt of single spheres.
    const auto flank = cone(25.0, 0.1);
    const auto surface = [&](double r, double azimuth) {
        const double height = flank(r, azimuth);
        return height > 0.085 ? 0.085 + 0.3 * (height - 0.085) : std::max(height, r < 0.28 ? diameter : 0.0);
    };
    CHECK(Heap(surface).angle().value == Approx(25.0).margin(0.7));
}

TEST_CASE("given radii choose the part of the flank", "[repose]")
{
    // 30 degrees up to a radius of 0.1, 15 beyond.
    const auto broken = [](double r, double) {
        const double fall = std::min(r, 0.1) * std::tan(30 * degree) + std::max(0.0, r - 0.1) * std::tan(15 * degree);
        return 0.12 - fall;
    };
    const Heap heap(broken);
    CHECK(heap.angle(0.02, 0.1).value == Approx(30.0).margin(0.3));
    CHECK(heap.angle(0.1, 0.25).value == Approx(15.0).margin(0.3));
}

TEST_CASE("the spread tells how much the sides of a heap differ", "[repose]")
{
    // Two halves of 22 and 28 degrees: over eight octants a standard deviation of 3 degrees times √(8/7), over √8.
    const auto lopsided = [](double r, double azimuth) {
        return 0.1 - r * std::tan((azimuth < std::numbers::pi ? 22.0 : 28.0) * degree);
    };
    const auto measured = Heap(lopsided).angle(0.02, 0.15);
    CHECK(measured.value == Approx(25.0).margin(0.7));
    CHECK(measured.spread == Approx(3.0 / std::sqrt(7.0)).epsilon(0.25));
}

TEST_CASE("each of the eight octants counts for the spread", "[repose]")
{
    // 20, 22 to 34 degrees, octant by octant: a standard deviation of √24 degrees, over √8.
    const auto screw = [](double r, double azimuth) {
        return 0.15 - r * std::tan((20.0 + 2.0 * std::floor(azimuth / (45.0 * degree))) * degree);
    };
    CHECK(Heap(screw).angle(0.02, 0.15).spread == Approx(std::sqrt(3.0)).epsilon(0.1));
}

TEST_CASE("the apex is the height of the heap over its base", "[repose]")
{
    Repose sensor("heap", Vec3(0.3, -0.2, 0.1), 0.0, 0.0);
    const Heap heap(cone(25.0, 0.1));
    sample(sensor, heap.state, heap.model);
    const auto apex = sensor.latest()[1];
    CHECK(apex.name == "apex");
    CHECK(apex.value == Approx(0.1).margin(0.5 * diameter));
}

TEST_CASE("spheres that have fallen off the plate do not count", "[repose]")
{
    Heap heap(cone(25.0, 0.1));
    const double angle = heap.angle().value;
    for (int k = 0; k < 100; ++k)
        add_sphere(heap.state, heap.base + Vec3(0.01 * k, 0, -0.5), 0.5 * diameter, 2500.0, 0);
    CHECK(heap.angle().value == angle);
}

TEST_CASE("where there is no heap there is no angle", "[repose][degenerate]")
{
    Model model;
    model.mean_diameter = diameter;
    State state;
    Repose sensor("heap", Vec3::Zero(), 0.0, 0.0);
    sample(sensor, state, model);
    CHECK(std::isnan(sensor.results()[0].value));
    add_sphere(state, Vec3(0.05, 0, 0.005), 0.005, 2500.0, 0);
    sample(sensor, state, model);
    CHECK(std::isnan(sensor.results()[0].value));
}

TEST_CASE("what is no heap has no angle, and says why", "[repose]")
{
    const auto judge = [](const Heap& heap) {
        Repose sensor("heap", heap.base, 0.0, 0.0);
        sample(sensor, heap.state, heap.model);
        return std::pair{sensor.results()[0].value, sensor.silence()};
    };
    Heap falling(cone(25.0, 0.1));
    CHECK(judge(falling).first == Approx(25.0).margin(0.3));
    const auto moved = falling.state.count() / 10;
    for (std::size_t i = 0; i < moved; ++i) falling.state.body(i).velocity.z() = -0.2;
    CHECK(std::isnan(judge(falling).first));
    CHECK(judge(falling).second == "no heap: 10 % of the mass falls or flows");

    const auto flat = judge(Heap([](double, double) { return 1.5 * diameter; }));
    CHECK(std::isnan(flat.first));
    CHECK(flat.second == "no heap: it is 1.5 diameters high");

    const auto steep = judge(Heap(cone(80.0, 0.1)));
    CHECK(std::isnan(steep.first));
    CHECK(steep.second == "no heap: its flank is 0.99 diameters wide");
}

TEST_CASE("grains in the air are no part of the surface", "[repose]")
{
    Heap heap(cone(25.0, 0.1));
    const double still = heap.angle().value;
    for (int k = 0; k < 20; ++k) {
        add_sphere(heap.state, heap.base + Vec3(0, 0, 0.2 + 0.01 * k), 0.5 * diameter, 2500.0, 0);
        heap.state.bodies.back().velocity.z() = -1.0;
    }
    CHECK(heap.angle().value == still);
}
