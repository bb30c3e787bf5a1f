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
        *inside_of(box_mesh({place, Vec3(1.0, 1.5, 0.7)}), 0.0), *inside_of(l_mesh(), 0.0));
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
    CHECK_FALSE(inside_of(make_mesh(open.vertices, open.triangles), 0.0));
    CHECK_FALSE(inside_of(box_panels({Vec3::Zero(), Vec3::Ones()}, {"z+"}), 0.0));
    CHECK(inside_of(box_panels({Vec3::Zero(), Vec3::Ones()}, {}), 0.0)->volume() == Approx(1.0));
    CHECK_FALSE(inside_of(Plane{}, 0.0));
}

TEST_CASE("a mesh is closed where its corners agree, whatever way its triangles turn", "[region]")
{
    constexpr double weld = 1e-6;
    const auto seed = GENERATE(range(1, 30));
    INFO("seed " << seed);
    Random random(static_cast<std::uint64_t>(seed));
    const Mesh whole = seed % 2 ? box_mesh({Vec3::Zero(), Vec3(1.0, 1.5, 0.7)}) : l_mesh();
    const auto inside = inside_of(whole, 0.0);
    // Every triangle gets corners of its own, some off by almost all that is allowed.
    const double off = seed % 3 ? 0.49 * weld : 1e-17;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(uniform(random), Vec3(1, 2, 3).normalized()));
    std::vector<Vec3> corners;
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (const auto& t : whole.triangles) {
        const auto first = static_cast<std::int32_t>(corners.size());
        for (const auto corner : t) {
            Vec3 away(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
            corners.push_back(turn * whole.vertices[corner] + off * away.normalized());
        }
        triangles.push_back({first, first + 1, first + 2});
        if (uniform(random) < 0.5) std::swap(triangles.back()[0], triangles.back()[1]);
    }
    const auto welded = inside_of(make_mesh(corners, triangles), weld);
    REQUIRE(welded);
    CHECK(welded->volume() == Approx(inside->volume()).epsilon(1e-5));
    for (int k = 0; k < 200; ++k) {
        const Vec3 x = place_in(inside->bounds().grown(0.3), random);
        CHECK(welded->depth(turn * x) == Approx(inside->depth(x)).margin(2 * weld));
    }
    // Corners that are further apart leave it open.
    if (seed % 3) CHECK_FALSE(inside_of(make_mesh(corners, triangles), 1e-3 * weld));
}

TEST_CASE("a hole of a mesh has a place and a length", "[region]")
{
    Mesh open = box_mesh({Vec3::Zero(), Vec3(1.0, 1.5, 0.7)});
    const auto gone = open.triangles.back();
    open.triangles.pop_back();
    const std::vector<Hole> holes = ClosedMesh(make_mesh(open.vertices, open.triangles), 0.0).holes();
    REQUIRE(holes.size() == 1);
    CHECK(holes[0].edges == 3);
    const Vec3 &a = open.vertices[gone[0]], &b = open.vertices[gone[1]], &c = open.vertices[gone[2]];
    CHECK((holes[0].place - (a + b + c) / 3.0).norm() < 1e-12);
    CHECK(holes[0].length == Approx((a - b).norm() + (b - c).norm() + (c - a).norm()));
}

TEST_CASE("a shell within a shell encloses what is between them", "[region]")
{
    const Mesh outer = box_mesh({Vec3::Zero(), Vec3(3, 3, 3)}), inner = box_mesh({Vec3::Ones(), Vec3(2, 2, 2)});
    std::vector<Vec3> corners = outer.vertices;
    auto triangles = outer.triangles;
    for (const auto& t : inner.triangles) triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    corners.insert(corners.end(), inner.vertices.begin(), inner.vertices.end());
    REQUIRE(outer.vertices.size() == 8);
    const auto between = inside_of(make_mesh(corners, triangles), 0.0);
    REQUIRE(between);
    CHECK(between->volume() == Approx(26.0));
    CHECK(between->depth(Vec3(1.5, 1.5, 1.5)) == Approx(-0.5));
    CHECK(between->depth(Vec3(0.5, 1.5, 1.5)) == Approx(0.5));
}
