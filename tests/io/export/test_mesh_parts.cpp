// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/mesh_parts.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;

namespace
{

/// A funnel under a tube, round the line through (0.3, 0.1) along x, y or z, of so many sides; `share` of its way
/// round.
Mesh funnel(int axis, int sides, double share = 1.0)
{
    const std::array<std::array<double, 2>, 3> rings = {{{0.0, 0.02}, {0.1, 0.08}, {0.3, 0.08}}}; // place, radius
    std::vector<Vec3> corners;
    for (const auto& [place, radius] : rings)
        for (int k = 0; k < sides; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / sides;
            Vec3 corner;
            corner[axis] = place;
            corner[(axis + 1) % 3] = 0.3 + radius * std::cos(angle);
            corner[(axis + 2) % 3] = 0.1 + radius * std::sin(angle);
            corners.push_back(corner);
        }
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (int ring = 0; ring < 2; ++ring)
        for (int k = 0; k < std::lround(share * sides); ++k) {
            const int a = ring * sides + k, b = ring * sides + (k + 1) % sides;
            triangles.push_back({a, b, b + sides});
            triangles.push_back({a, b + sides, a + sides});
        }
    return make_mesh(corners, triangles);
}

} // namespace

TEST_CASE("a round mesh is cones, along any axis", "[export]")
{
    const int axis = GENERATE(0, 1, 2);
    const RoundParts parts = round_parts(funnel(axis, 32));
    REQUIRE(parts.shapes.size() == 2);
    const Cone &lower = std::get<Cone>(parts.shapes[0]), &upper = std::get<Cone>(parts.shapes[1]);
    CHECK(lower.base_radius == Approx(0.02));
    CHECK(lower.top_radius == Approx(0.08));
    CHECK(lower.height == Approx(0.1));
    CHECK(upper.base_radius == Approx(0.08));
    CHECK(upper.top_radius == Approx(0.08));
    CHECK(upper.height == Approx(0.2));
    CHECK(std::abs(lower.base[axis]) < 1e-12);
    CHECK(upper.base[axis] == Approx(0.1));
    CHECK(lower.base[(axis + 1) % 3] == Approx(0.3));
    CHECK(lower.base[(axis + 2) % 3] == Approx(0.1));
    CHECK(parts.sag == Approx(0.08 * (1.0 - std::cos(std::numbers::pi / 32)))); // the middle of a chord
}

TEST_CASE("what is slit, has few sides or is turned is not round", "[export]")
{
    CHECK(round_parts(funnel(2, 32, 0.75)).shapes.empty());
    CHECK(round_parts(funnel(2, 6)).shapes.empty());
    Mesh turned = funnel(2, 32);
    for (Vec3& corner : turned.vertices) corner = Eigen::AngleAxisd(0.1, Vec3::UnitX()) * corner;
    CHECK(round_parts(turned).shapes.empty());
}

TEST_CASE("a flat ring and a lid are disks", "[export]")
{
    std::vector<Vec3> corners = {Vec3(0, 0, 0.5)};
    std::vector<std::array<std::int32_t, 3>> lid, ring;
    const int sides = 40;
    for (const double radius : {0.1, 0.2})
        for (int k = 0; k < sides; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / sides;
            corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.5);
        }
    for (int k = 0; k < sides; ++k) {
        const int a = 1 + k, b = 1 + (k + 1) % sides;
        lid.push_back({0, a, b});
        ring.push_back({a, b, b + sides});
        ring.push_back({a, b + sides, a + sides});
    }
    // corners that no triangle has would count as well, so the lid has those of the small circle only
    const RoundParts small = round_parts(make_mesh({corners.begin(), corners.begin() + 1 + sides}, lid));
    REQUIRE(small.shapes.size() == 1);
    CHECK(std::get<Disk>(small.shapes[0]).radius == Approx(0.1));
    CHECK(std::get<Disk>(small.shapes[0]).hole_radius == Approx(0.0).margin(1e-12));
    const RoundParts wide = round_parts(make_mesh(corners, ring));
    REQUIRE(wide.shapes.size() == 1);
    CHECK(std::get<Disk>(wide.shapes[0]).radius == Approx(0.2));
    CHECK(std::get<Disk>(wide.shapes[0]).hole_radius == Approx(0.1));
    CHECK(std::get<Disk>(wide.shapes[0]).center.z() == Approx(0.5));
}

TEST_CASE("triangles in pairs are plates, and a single one is none", "[export]")
{
    const std::vector<Vec3> corners = {Vec3(0, 0, 0), Vec3(0, 2, 0), Vec3(1, 2, 1), Vec3(1, 0, 1), Vec3(3, 0, 1)};
    const std::vector<Plate> one = plates(make_mesh(corners, {{0, 1, 2}, {2, 3, 0}}));
    REQUIRE(one.size() == 1);
    CHECK(one[0].edge_a.cross(one[0].edge_b).norm() == Approx(2.0 * std::sqrt(2.0)));
    Box box;
    for (const double s : {0.0, 1.0})
        for (const double t : {0.0, 1.0}) box.extend(one[0].corner + s * one[0].edge_a + t * one[0].edge_b);
    CHECK((box.min - Vec3(0, 0, 0)).norm() < 1e-12);
    CHECK((box.max - Vec3(1, 2, 1)).norm() < 1e-12);
    CHECK(plates(make_mesh(corners, {{0, 1, 2}, {2, 3, 0}, {2, 3, 4}})).empty());
}
