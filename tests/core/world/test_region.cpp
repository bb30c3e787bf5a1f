// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/closed_mesh.hpp"
#include "tests/support/regions.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

Region any_region()
{
    const Vec3 axis = Vec3(1, 2, 2) / 3.0, place(0.3, -0.2, 0.1);
    return GENERATE_COPY(box(place, Vec3(1.0, 1.5, 0.7)), cylinder(place, axis, 0.8, 0.6),
        cone(place, axis, 1.0, 0.3, 0.8), cone(place, axis, 0.0, 0.9, 1.3), sphere(place, 0.9),
        *inside_of(box_mesh({place, Vec3(1.0, 1.5, 0.7)})), *inside_of(l_mesh()));
}

/// A place in the box, drawn evenly.
Vec3 place_in(const Box& box, Random& random)
{
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = box.min[d] + uniform(random) * box.extent()[d];
    return x;
}

/// Points spread evenly over a ball's surface (a spiral).
std::vector<Vec3> surface_of_ball(const Vec3& center, double radius)
{
    std::vector<Vec3> points;
    const int count = 400;
    for (int k = 0; k < count; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / count, turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * k;
        const double out = std::sqrt(1.0 - z * z);
        points.push_back(center + radius * Vec3(out * std::cos(turn), out * std::sin(turn), z));
    }
    return points;
}

} // namespace

TEST_CASE("the depth of a place is its distance from the region's border", "[region]")
{
    const Region region = any_region();
    Random random(1);
    const Box around = region.bounds().grown(0.3);
    int inside = 0;
    for (int k = 0; k < 300; ++k) {
        const Vec3 x = place_in(around, random);
        const double depth = region.depth(x);
        INFO("place " << x.transpose() << ", depth " << depth);
        CHECK(region.contains(x) == (depth >= 0.0));
        inside += depth >= 0.0;
        if (std::abs(depth) < 0.02) continue;
        // A slightly smaller ball lies on one side wholly, and the steepest way leads to the border.
        const auto all_on_its_side = [&](const std::vector<Vec3>& points) {
            return std::ranges::all_of(points, [&](const Vec3& y) { return region.contains(y) == (depth > 0.0); });
        };
        CHECK(all_on_its_side(surface_of_ball(x, 0.999 * std::abs(depth))));
        Vec3 slope;
        for (int d = 0; d < 3; ++d)
            slope[d] = (region.depth(x + 1e-6 * Vec3::Unit(d)) - region.depth(x - 1e-6 * Vec3::Unit(d))) / 2e-6;
        if (slope.norm() > 0.999) // elsewhere two places of the border are as near
            CHECK_FALSE(all_on_its_side(surface_of_ball(x - depth * slope, 0.01)));
        if (depth > 0.0) CHECK(region.contains(x, 0.999 * depth));
    }
    CHECK(inside > 30);
}

TEST_CASE("a region's bounds and volume are those of the places inside", "[region]")
{
    const Region region = any_region();
    const Box bounds = region.bounds(), around = bounds.grown(0.2);
    Random random(2);
    const int count = 20000;
    int inside = 0;
    Box seen;
    for (int k = 0; k < count; ++k) {
        const Vec3 x = place_in(around, random);
        if (!region.contains(x)) continue;
        ++inside;
        seen.extend(x);
    }
    CHECK(bounds.contains(seen));
    CHECK((bounds.extent() - seen.extent()).maxCoeff() < 0.25); // tips of cones are seldom hit
    const double share = static_cast<double>(inside) / count;
    const double deviation = std::sqrt(share * (1.0 - share) / count);
    CHECK(std::abs(region.volume() / around.extent().prod() - share) < 4.0 * deviation);
}

TEST_CASE("random points of a region hold the ball, and a ball that fits nowhere is known", "[region]")
{
    const Region region = any_region();
    Random random(3);
    REQUIRE(region.fits(0.1));
    CHECK_FALSE(region.fits(2.0));
    int found = 0;
    for (int k = 0; k < 1000; ++k) {
        const auto x = region.random_point(random, 0.1);
        if (!x) continue;
        ++found;
        CHECK(region.contains(*x, 0.1 - 1e-12));
    }
    CHECK(found > 50);
}

TEST_CASE("only what is closed has an inside", "[region]")
{
    Mesh open = box_mesh({Vec3::Zero(), Vec3::Ones()});
    open.triangles.pop_back();
    CHECK_FALSE(inside_of(make_mesh(open.vertices, open.triangles)));
    CHECK_FALSE(inside_of(box_panels({Vec3::Zero(), Vec3::Ones()}, {"z+"})));
    CHECK(inside_of(box_panels({Vec3::Zero(), Vec3::Ones()}, {}))->volume() == Approx(1.0));
    CHECK_FALSE(inside_of(Plane{}));
}
