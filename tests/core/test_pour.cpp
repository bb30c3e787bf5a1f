// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pour.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

using namespace talus;

namespace
{

/// Beads of 8 to 10 mm into a cube of 50 mm that a ball of 20 mm and a plate reach into.
struct Pouring {
    Model model;
    State state;
    Pour source;

    Pouring(std::int64_t count, double rate)
    {
        model.materials = {{{"grain", 2500.0}}, {ContactLaw{}}};
        model.walls.push_back({"plate", Disk{Vec3(0.025, 0.025, 0.01), Vec3::UnitZ(), 0.02, 0.0}, 0});
        add_sphere(state, Vec3(0.05, 0.05, 0.05), 0.01, 2500.0, 0);
        source.region.box = {Vec3::Zero(), Vec3::Constant(0.05)};
        source.diameter = {0.008, 0.01};
        source.count = count;
        source.rate = rate;
        source.velocity = Vec3(0, 0, -1);
    }

    std::size_t pour_at(double time)
    {
        state.time = time;
        return pour(source, state, model);
    }

    double least_gap() const
    {
        double gap = infinity;
        for (std::size_t i = 0; i < state.count(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                gap = std::min(gap, (state.position[i] - state.position[j]).norm() - state.radius(i) - state.radius(j));
            gap = std::min(gap, nearest_point(model.walls[0].shape, 0, state.position[i]).distance - state.radius(i));
        }
        return gap;
    }
};

} // namespace

TEST_CASE("poured spheres overlap nothing and lie in their region, until it is full and after", "[pour]")
{
    Pouring pouring(1000, 1e6);
    for (int k = 0; k < 10; ++k) pouring.pour_at(0.01 * (k + 1));
    CHECK(pouring.source.poured > 50);
    CHECK(pouring.source.poured < 190); // what 64 % of the cube would be, of the mean size
    CHECK(pouring.state.count() == static_cast<std::size_t>(pouring.source.poured) + 1);
    CHECK(pouring.least_gap() >= 0.0);
    for (std::size_t i = 1; i < pouring.state.count(); ++i) {
        CHECK(pouring.source.region.contains(pouring.state.position[i], pouring.state.radius(i)));
        CHECK(pouring.state.motion[i].velocity == pouring.source.velocity);
    }
}

TEST_CASE("a sphere that finds no place waits, is counted, and comes when there is room", "[pour]")
{
    Pouring pouring(1000, 1e6);
    for (int k = 0; k < 10; ++k) pouring.pour_at(0.01 * (k + 1));
    const auto poured = pouring.source.poured;
    CHECK(pouring.source.refused == 10);
    const double waiting = pouring.source.pending_diameter;
    CHECK(waiting > 0.0);

    for (std::size_t i = 1; i < pouring.state.count(); ++i) pouring.state.position[i].z() -= 1.0;
    CHECK(pouring.pour_at(0.2) > 0);
    CHECK(pouring.source.poured > poured);
    CHECK(pouring.state.radius(static_cast<std::size_t>(poured) + 1) == 0.5 * waiting); // the one that waited, first
}

TEST_CASE("a pour lets in its rate from its start on, and no more than its count", "[pour]")
{
    Pouring pouring(25, 100.0);
    pouring.source.start = 1.0;
    CHECK(pouring.pour_at(0.999) == 0);
    CHECK(pouring.pour_at(1.0) == 1);
    CHECK(pouring.pour_at(1.0) == 0); // nothing twice
    CHECK(pouring.pour_at(1.055) == 5);
    CHECK(pouring.source.poured == 6);
    pouring.pour_at(9.0);
    CHECK(pouring.source.poured == 25);
    CHECK(pouring.pour_at(99.0) == 0);
    CHECK(pouring.source.refused == 0);
}

TEST_CASE("a wall that does not stand is no obstacle to a pour", "[pour]")
{
    // The plate of a mould as large as the region: no sphere fits while it is closed.
    Pouring pouring(5, 1e6);
    pouring.source.region.box = {Vec3::Zero(), Vec3(0.02, 0.02, 0.012)};
    pouring.model.walls = {{"plate", Disk{Vec3(0.01, 0.01, 0.006), Vec3::UnitZ(), 0.02, 0.0}, 0, 1.0, 2.0}};
    CHECK(pouring.pour_at(1.5) == 0);
    CHECK(pouring.source.refused == 1);
    CHECK(pouring.pour_at(2.0) > 0);
}

TEST_CASE("diameters of a pour fill their range evenly", "[pour]")
{
    const SizeDistribution sizes{0.002, 0.01};
    Random random(1);
    constexpr int draws = 100000;
    double sum = 0.0, volume = 0.0;
    for (int k = 0; k < draws; ++k) {
        const double d = sizes.draw(random);
        REQUIRE((d >= sizes.min && d < sizes.max));
        sum += d;
        volume += std::numbers::pi / 6.0 * d * d * d;
    }
    // Standard errors of the two means: 0.12 % and 0.30 % (relative spreads 0.385 and 0.95 over √100000).
    CHECK(sum / draws == Approx(sizes.mean()).epsilon(0.005));
    CHECK(volume / draws == Approx(sizes.mean_volume()).epsilon(0.012));
}
