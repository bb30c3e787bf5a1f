// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/region_share.hpp"
#include "tests/support/regions.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

Region tilted_cylinder()
{
    return cylinder(Vec3(0.1, -0.2, 0.3), Vec3(1, 2, 2) / 3.0, 1.2, 1.5);
}

/// The share of a ball by counting the points of a fine lattice inside.
double counted_share(const Region& region, const Vec3& center, double radius)
{
    constexpr int steps = 100;
    int inside = 0, all = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            for (int k = 0; k < steps; ++k) {
                const Vec3 x = radius * (2.0 * (Vec3(i, j, k).array() + 0.5) / steps - 1.0);
                if (x.norm() > radius) continue;
                ++all;
                inside += region.contains(center + x);
            }
    return static_cast<double>(inside) / all;
}

} // namespace

TEST_CASE("the share of a ball is 1 inside, 0 outside, and a spherical cap's at a face", "[region_share]")
{
    const Region region = box(Vec3(-10, -10, 0), Vec3(10, 10, 10));
    CHECK(ball_share(region, Vec3(0, 0, 5), 1.0) == 1.0);
    CHECK(ball_share(region, Vec3(0, 0, -1.01), 1.0) == 0.0);
    CHECK(ball_share(region, Vec3(0, 0, 0), 1.0) == Approx(0.5).epsilon(1e-14));
    // A cap of height H = 0.6: π H² (3 r − H) / 3 of 4/3 π r³.
    CHECK(ball_share(region, Vec3(0, 0, -0.4), 1.0) == Approx(0.36 * 2.4 / 4.0).epsilon(1e-14));
    // A box thinner than the ball cuts off both caps.
    CHECK(ball_share(box(Vec3(-10, -0.4, -10), Vec3(10, 0.4, 10)), Vec3::Zero(), 1.0) ==
          Approx(1.0 - 2.0 * 0.36 * 2.4 / 4.0).epsilon(1e-14));
}

TEST_CASE("the share of a ball at edges and corners is right to a thousandth", "[region_share]")
{
    const double margin = 1e-3;
    const Region corner = box(Vec3::Zero(), Vec3::Constant(10.0));
    CHECK(ball_share(corner, Vec3(0, 0, 5), 1.0) == Approx(0.25).margin(margin));
    CHECK(ball_share(corner, Vec3(0, 5, 0), 1.0) == Approx(0.25).margin(margin));
    CHECK(ball_share(corner, Vec3::Zero(), 1.0) == Approx(0.125).margin(margin));
    const Region small = box(Vec3(-0.5, -0.3, -0.7), Vec3(0.2, 0.6, 0.4)); // inside the ball wholly or nearly
    const Region tube = tilted_cylinder();
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.3, -0.2, 0.1), Vec3(-0.6, 0.5, 0.4), Vec3(0.9, 0.8, 0.7)}) {
        INFO(x.transpose());
        // Counting errs by a share of the lattice's step at the surface.
        CHECK(ball_share(small, x, 1.0) == Approx(counted_share(small, x, 1.0)).margin(margin + 2e-3));
        CHECK(ball_share(corner, x, 1.0) == Approx(counted_share(corner, x, 1.0)).margin(margin + 2e-3));
        CHECK(ball_share(tube, x, 1.0) == Approx(counted_share(tube, x, 1.0)).margin(margin + 2e-3));
    }
}

TEST_CASE("the shares of a ball in the parts of a region add up", "[region_share]")
{
    const Vec3 x(0.31, 0.17, -0.23);
    double sum = 0.0;
    for (const double x0 : {-2.0, 0.0})
        for (const double y0 : {-2.0, 0.0})
            for (const double z0 : {-2.0, 0.0})
                sum += ball_share(box(Vec3(x0, y0, z0), Vec3(x0, y0, z0).array() + 2.0), x, 1.0);
    CHECK(sum == Approx(1.0).margin(1e-3));
}

TEST_CASE("the share of a line is its length inside", "[region_share]")
{
    const Region cube = box(Vec3::Zero(), Vec3::Ones());
    CHECK(segment_share(cube, Vec3(0.5, 0.5, -1), Vec3(0.5, 0.5, 3)) == Approx(0.25));
    CHECK(segment_share(cube, Vec3(0.1, 0.2, 0.3), Vec3(0.9, 0.8, 0.7)) == 1.0);
    CHECK(segment_share(cube, Vec3(0.5, 0.5, 0.5), Vec3(2.5, 0.5, 0.5)) == Approx(0.25));
    CHECK(segment_share(cube, Vec3(-1, 1.5, 0.5), Vec3(2, 1.5, 0.5)) == 0.0);
    CHECK(segment_share(cube, Vec3(-1, 0.5, 0.5), Vec3(-2, 0.5, 0.5)) == 0.0);

    const Region tube = cylinder(Vec3::Zero(), Vec3::UnitZ(), 1.0, 2.0);
    CHECK(segment_share(tube, Vec3(-2, 0, 1), Vec3(2, 0, 1)) == Approx(0.5));
    CHECK(segment_share(tube, Vec3(-2, 0.8, 1), Vec3(2, 0.8, 1)) == Approx(0.3)); // a chord of 1.2
    CHECK(segment_share(tube, Vec3(0.5, 0, -2), Vec3(0.5, 0, 2)) == Approx(0.5));
    CHECK(segment_share(tube, Vec3(1.5, 0, -2), Vec3(1.5, 0, 2)) == 0.0);
    CHECK(segment_share(tube, Vec3(-2, 1.1, 1), Vec3(2, 1.1, 1)) == 0.0);
}

TEST_CASE("the volume of a region", "[region_share]")
{
    CHECK(box(Vec3(1, 1, 1), Vec3(2, 3, 5)).volume() == Approx(8.0));
    CHECK(tilted_cylinder().volume() == Approx(std::numbers::pi * 1.2 * 1.2 * 1.5));
}
