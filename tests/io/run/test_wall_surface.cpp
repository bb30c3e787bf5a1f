// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/wall_surface.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;

namespace
{

const Box contents{Vec3(0, 0, 0), Vec3(4, 2, 1)};

double area_of(const TriangleSoup& soup)
{
    const auto vertex = [&](std::int32_t i) { return soup.vertices.at(static_cast<std::size_t>(i)); };
    double area = 0.0;
    for (const auto& [a, b, c] : soup.triangles)
        area += 0.5 * (vertex(b) - vertex(a)).cross(vertex(c) - vertex(a)).norm();
    return area;
}

Vec3 mean_vertex(const TriangleSoup& soup)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& vertex : soup.vertices) sum += vertex;
    return sum / static_cast<double>(soup.vertices.size());
}

/// Area of a regular polygon of 64 corners / area of its circle, and so for bands between such polygons.
const double polygon_share = 64 / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi / 64);

} // namespace

TEST_CASE("a plane is drawn twice as wide as what there is to be seen, round its centre", "[wall_surface]")
{
    const TriangleSoup soup = wall_surface(Plane{Vec3(100, 0, 0.5), Vec3::UnitZ()}, contents);
    CHECK(soup.triangles.size() == 2);
    CHECK(area_of(soup) == Approx(64.0)); // the widest extent is 4
    CHECK(mean_vertex(soup).isApprox(Vec3(2, 1, 0.5)));
}

TEST_CASE("a disk with a hole has the area of the ring", "[wall_surface]")
{
    const TriangleSoup ring = wall_surface(Disk{Vec3::Zero(), Vec3::UnitX(), 2.0, 1.0}, contents);
    CHECK(ring.triangles.size() == 128);
    CHECK(area_of(ring) == Approx(3 * std::numbers::pi * polygon_share));
    const TriangleSoup plate = wall_surface(Disk{Vec3::Zero(), Vec3::UnitX(), 2.0, 0.0}, contents);
    CHECK(plate.triangles.size() == 64); // none without area at the centre
    CHECK(area_of(plate) == Approx(4 * std::numbers::pi * polygon_share));
}

TEST_CASE("tubes and funnels stand between their ends", "[wall_surface]")
{
    const Vec3 axis = Vec3(0, 3, 4) / 5;
    const TriangleSoup tube = wall_surface(Cylinder{Vec3(1, 0, 0), axis, 0.5, 2.0}, contents);
    CHECK(tube.triangles.size() == 128);
    CHECK(area_of(tube) == Approx(64 * 2 * 0.5 * std::sin(std::numbers::pi / 64) * 2.0)); // chords × height
    CHECK(mean_vertex(tube).isApprox(Vec3(1, 0, 0) + axis));

    const TriangleSoup funnel = wall_surface(Cone{Vec3::Zero(), Vec3::UnitZ(), 0.0, 1.0, 1.0}, contents);
    CHECK(funnel.triangles.size() == 64); // a pointed one
    for (const Vec3& vertex : funnel.vertices) CHECK(vertex.head<2>().norm() == Approx(vertex.z()).margin(1e-15));
}

TEST_CASE("the faces of a box that are not open are drawn", "[wall_surface]")
{
    const TriangleSoup soup = wall_surface(box_panels({Vec3::Zero(), Vec3(1, 2, 3)}, {"z+"}), contents);
    CHECK(soup.triangles.size() == 10);
    CHECK(area_of(soup) == Approx(2 * (2 * 3) + 2 * (1 * 3) + 1 * 2));
}

TEST_CASE("a mesh is drawn as it is", "[wall_surface]")
{
    const TriangleSoup soup =
        wall_surface(make_mesh({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}}), contents);
    CHECK(soup.triangles.size() == 1);
    CHECK(area_of(soup) == Approx(0.5));
}
