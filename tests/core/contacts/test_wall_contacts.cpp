// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/contacts/wall_contacts.hpp"
#include "tests/support/mesh_cell.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

using namespace talus;

namespace
{

using Triangle = std::array<std::int32_t, 3>;

/// All contacts of a sphere with a shape, whatever patches are near.
std::vector<WallPoint> contacts_of(const Shape& shape, const Vec3& x, double radius)
{
    const Wall wall{"wall", shape};
    const PlacedWall placed(wall, {}, 0.0);
    std::vector<WallPoint> points;
    for (std::size_t patch = 0; patch < patch_count(shape); ++patch)
        if (const WallPoint at = placed.nearest_point(patch, x); at.distance <= radius) points.push_back(at);
    keep_local_minima(placed, radius, points);
    return points;
}

/// The floor z = 0 from −4 to 4 in squares of 1, each cut along one diagonal or the other.
Mesh tessellated_floor(const std::string& diagonals)
{
    constexpr int n = 9;
    std::vector<Vec3> vertices;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) vertices.emplace_back(i - 4, j - 4, 0.0);
    std::vector<Triangle> triangles;
    for (int i = 0; i + 1 < n; ++i)
        for (int j = 0; j + 1 < n; ++j) {
            const int a = i * n + j, b = a + n;
            test::add_cell(triangles, {a, b, b + 1, a + 1}, diagonals, i, j);
        }
    return make_mesh(vertices, triangles);
}

/// Two strips that meet along the y axis, one flat and one that rises by an angle: a concave fold if that is positive.
Mesh fold(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return make_mesh(
        {Vec3(-5, -5, 0), Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(-5, 5, 0), Vec3(5 * c, -5, 5 * s), Vec3(5 * c, 5, 5 * s)},
        {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
}

} // namespace

TEST_CASE("a sphere has one contact with a flat floor, however it is tessellated", "[wall_contacts]")
{
    const Shape floor = tessellated_floor(GENERATE(as<std::string>{}, "rising", "falling", "mixed"));
    const double height = GENERATE(0.3, 0.999, 1.0);
    const double radius = 1.0; // reaches over many triangles
    const auto check = [&](const Vec3& x) {
        const auto points = contacts_of(floor, x, radius);
        CAPTURE(x.transpose());
        REQUIRE(points.size() == 1);
        CHECK((points[0].point - Vec3(x[0], x[1], 0)).norm() < 1e-7);
        CHECK((points[0].normal - Vec3::UnitZ()).norm() < 1e-7);
        CHECK(points[0].distance == Approx(height));
    };
    SECTION("over a vertex")
    {
        check(Vec3(0, 0, height));
    }
    SECTION("over an edge")
    {
        check(Vec3(0, 0.37, height));
        check(Vec3(0.37, 0, height));
    }
    SECTION("over both diagonals")
    {
        check(Vec3(0.3, 0.3, height));
        check(Vec3(0.3, 0.7, height));
        check(Vec3(0.5, 0.5, height));
    }
    SECTION("close to an edge, a diagonal and a vertex, at every scale")
    {
        for (double away = 0.1; away > 1e-12; away /= 3.0) {
            check(Vec3(away, 0.37, height));
            check(Vec3(0.3 + away, 0.3, height));
            check(Vec3(0.3 - away, 0.7, height));
            check(Vec3(away, 2.0 * away, height));
        }
    }
    SECTION("anywhere")
    {
        Random random(1);
        for (int k = 0; k < 1000; ++k) check(Vec3(4 * uniform(random) - 2, 4 * uniform(random) - 2, height));
    }
    SECTION("from below")
    {
        const auto points = contacts_of(floor, Vec3(0.2, 0.1, -height), radius);
        REQUIRE(points.size() == 1);
        CHECK((points[0].normal + Vec3::UnitZ()).norm() < 1e-12);
    }
}

TEST_CASE("a sphere that does not reach the floor has no contact", "[wall_contacts]")
{
    CHECK(contacts_of(tessellated_floor("mixed"), Vec3(0, 0, 1.0000001), 1.0).empty());
}

TEST_CASE("a sphere over a ridge has one contact, at its crest", "[wall_contacts]")
{
    const Shape ridge = fold(-GENERATE(0.1, 0.5, 1.5));
    const auto points = contacts_of(ridge, Vec3(0, 0.3, 0.9), 1.0);
    REQUIRE(points.size() == 1);
    CHECK((points[0].point - Vec3(0, 0.3, 0)).norm() < 1e-12);
}

TEST_CASE("a sphere in a valley has a contact with each side", "[wall_contacts]")
{
    const double angle = GENERATE(0.01, 0.1, 0.5, 1.5, 2.5);
    // Touching both sides: on the bisector, at the height of the radius over each.
    const Vec3 x = Vec3(-std::tan(0.5 * angle), 0.3, 1.0);
    const auto points = contacts_of(fold(angle), x, 1.0 + 1e-9);
    REQUIRE(points.size() == 2);
    CHECK(points[0].distance == Approx(1.0));
    CHECK(points[1].distance == Approx(1.0));
    CHECK(points[0].normal.dot(points[1].normal) == Approx(std::cos(angle)));
}

TEST_CASE("a sphere has as many contacts in a box as there are faces that it touches", "[wall_contacts]")
{
    const Shape box = box_panels({Vec3::Zero(), Vec3::Constant(10)}, {"z+"});
    CHECK(contacts_of(box, Vec3(5, 5, 0.9), 1.0).size() == 1);
    CHECK(contacts_of(box, Vec3(0.9, 5, 0.9), 1.0).size() == 2);    // a concave edge
    CHECK(contacts_of(box, Vec3(0.9, 0.95, 0.9), 1.0).size() == 3); // a corner
    CHECK(contacts_of(box, Vec3(9.2, 9.1, 0.9), 1.0).size() == 3);
    CHECK(contacts_of(box, Vec3(5, 5, 5), 1.0).empty());
}

TEST_CASE("a sphere outside a box touches its edge or corner once", "[wall_contacts]")
{
    const Shape box = box_panels({Vec3::Zero(), Vec3::Constant(10)}, {});
    CHECK(contacts_of(box, Vec3(-0.5, 5, -0.5), 1.0).size() == 1);
    CHECK(contacts_of(box, Vec3(-0.5, -0.5, -0.5), 1.0).size() == 1);
    CHECK(contacts_of(box, Vec3(5, 5, -0.5), 1.0).size() == 1);
}

TEST_CASE("a sphere on the rim of an open box has one contact", "[wall_contacts]")
{
    const Shape box = box_panels({Vec3::Zero(), Vec3::Constant(10)}, {"z+"});
    CHECK(contacts_of(box, Vec3(0.1, 5, 10.8), 1.0).size() == 1);
}

TEST_CASE("new contacts of a wall take over what the old ones with the nearest normals carried", "[wall_contacts]")
{
    Carried carried;
    carried.walls = CarriedImpulses(3, false);
    carried.wall_normal = {Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY()};
    auto& contact = carried.walls.contact;
    contact[0].impulse = Vec3(1, 0, 0);
    contact[1].impulse = Vec3(0, 0, 3);
    for (const std::size_t k : {0, 1}) contact[k].touch.note(TouchRecord::loaded);
    WallPair pair{.sphere = 0, .wall = 0, .first = 0, .patches = 3, .carried = 2};
    const auto towards = [](const Vec3& n) { return WallPoint{Vec3::Zero(), n.normalized(), 1.0}; };

    SECTION("in another order, with a new one between")
    {
        match_carried(carried, pair, {towards(Vec3(0.1, 0, 1)), towards(-Vec3::UnitY()), towards(Vec3(1, 0.1, 0))});
        CHECK(pair.carried == 3);
        CHECK(contact[0].impulse == Vec3(0, 0, 3));
        CHECK(contact[1].impulse == Vec3::Zero());
        CHECK(contact[2].impulse == Vec3(1, 0, 0));
        CHECK(contact[0].touch.is_loaded());
        CHECK_FALSE(contact[1].touch.is_loaded());
        CHECK(contact[2].touch.is_loaded());
    }
    SECTION("with one gone")
    {
        match_carried(carried, pair, {towards(Vec3::UnitZ())});
        CHECK(pair.carried == 1);
        CHECK(contact[0].impulse == Vec3(0, 0, 3));
    }
    SECTION("with all gone")
    {
        match_carried(carried, pair, {});
        CHECK(pair.carried == 0);
    }
    SECTION("with a normal that is too different to be the same contact")
    {
        match_carried(carried, pair, {towards(Vec3(0, -1, 0.9))});
        CHECK(contact[0].impulse == Vec3::Zero());
    }
}

TEST_CASE("a sphere that goes over to a facet of another direction takes nothing along", "[wall_contacts]")
{
    Carried carried;
    carried.walls = CarriedImpulses(1, false);
    carried.wall_normal = {Vec3::UnitZ()};
    WallPair pair{.sphere = 0, .wall = 0, .first = 0, .patches = 1, .carried = 1};
    for (const double turn : {0.7, 0.9}) { // rad
        carried.walls.contact[0].impulse = Vec3(0, 0, 3);
        carried.wall_normal = {Vec3::UnitZ()};
        const Vec3 normal(std::sin(turn), 0, std::cos(turn));
        match_carried(carried, pair, {WallPoint{Vec3::Zero(), normal, 1.0}});
        CHECK(carried.walls.contact[0].impulse == (turn < 0.8 ? Vec3(0, 0, 3) : Vec3(0, 0, 0)));
        CHECK(carried.wall_normal[0] == normal);
    }
}
