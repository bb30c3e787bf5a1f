// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/world/wall.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

using namespace talus;

namespace
{

using Placement = Eigen::Isometry3d;

const Placement in_place = Placement::Identity();

Placement turned()
{
    Placement placement = Placement::Identity();
    placement.translate(Vec3(0.3, -0.2, 0.5)).rotate(Eigen::AngleAxisd(1.1, Vec3(1, 2, -3).normalized()));
    return placement;
}

struct Sampled {
    std::string name;
    Shape shape;
    /// The surface over s and t in [0, 1].
    std::vector<std::function<Vec3(double, double)>> surfaces;
};

/// The surface that a line in a half-plane through the z axis sweeps out, from (radius, height) to (radius, height).
std::function<Vec3(double, double)> swept(double r0, double z0, double r1, double z1, const Placement& placement)
{
    return [=](double s, double t) -> Vec3 {
        const double r = r0 + s * (r1 - r0), turn = 2.0 * std::numbers::pi * t;
        return placement * Vec3(r * std::cos(turn), r * std::sin(turn), z0 + s * (z1 - z0));
    };
}

Sampled tube(const Placement& p)
{
    return {"cylinder", Cylinder{p * Vec3::Zero(), p.linear() * Vec3::UnitZ(), 0.5, 1.2}, {swept(0.5, 0, 0.5, 1.2, p)}};
}

Sampled funnel(const Placement& p)
{
    return {"cone", Cone{p * Vec3::Zero(), p.linear() * Vec3::UnitZ(), 0.2, 0.8, 0.7}, {swept(0.2, 0, 0.8, 0.7, p)}};
}

Sampled point_down(const Placement& p)
{
    return {"pointed cone", Cone{p * Vec3::Zero(), p.linear() * Vec3::UnitZ(), 0.0, 0.8, 0.7},
        {swept(0.0, 0, 0.8, 0.7, p)}};
}

Sampled plate(const Placement& p)
{
    return {"disk", Disk{p * Vec3::Zero(), p.linear() * Vec3::UnitZ(), 0.8, 0.0}, {swept(0.0, 0, 0.8, 0, p)}};
}

Sampled plate_with_hole(const Placement& p)
{
    return {
        "disk with a hole", Disk{p * Vec3::Zero(), p.linear() * Vec3::UnitZ(), 0.8, 0.3}, {swept(0.3, 0, 0.8, 0, p)}};
}

Sampled triangle(const Placement& p)
{
    const Vec3 a = p * Vec3(-0.5, -0.4, 0), b = p * Vec3(0.6, -0.3, 0.2), c = p * Vec3(0, 0.7, -0.1);
    return {"mesh", make_mesh({a, b, c}, {{0, 1, 2}}),
        {[=](double s, double t) -> Vec3 { return a + s * ((1 - t) * (b - a) + t * (c - a)); }}};
}

/// A box without lid, which keeps to the axes; each panel is a patch.
Sampled open_box()
{
    const Panels panels = box_panels({Vec3(-0.5, -0.4, 0), Vec3(0.5, 0.6, 1)}, {"z+"});
    Sampled sampled{"box", panels, {}};
    for (const auto& r : panels.rectangles)
        sampled.surfaces.push_back([=](double s, double t) -> Vec3 { return r.corner + s * r.edge_a + t * r.edge_b; });
    return sampled;
}

const std::vector<Sampled> shapes = {tube(in_place), tube(turned()), funnel(in_place), funnel(turned()),
    point_down(turned()), plate(in_place), plate(turned()), plate_with_hole(turned()), triangle(in_place),
    triangle(turned()), open_box()};

constexpr int samples = 150; ///< along each parameter of a surface

/// Half the longest way between neighbouring samples: no curve of these shapes is longer than 2 π 0.8.
constexpr double resolution = 2.0 * std::numbers::pi * 0.8 / samples;

double sampled_distance(const std::function<Vec3(double, double)>& surface, const Vec3& x)
{
    double distance = infinity;
    for (int i = 0; i <= samples; ++i)
        for (int j = 0; j <= samples; ++j)
            distance = std::min(distance, (surface(double(i) / samples, double(j) / samples) - x).norm());
    return distance;
}

Vec3 random_place(Random& random)
{
    return 3.0 * (Vec3(uniform(random), uniform(random), uniform(random)) - Vec3::Constant(0.5));
}

} // namespace

TEST_CASE("the nearest point of a patch is the nearest of all points on it", "[wall]")
{
    for (const auto& [name, shape, surfaces] : shapes) {
        DYNAMIC_SECTION(name)
        {
            REQUIRE(patch_count(shape) == surfaces.size());
            Random random(1);
            for (int k = 0; k < 10; ++k) {
                const Vec3 x = random_place(random);
                for (std::size_t patch = 0; patch < surfaces.size(); ++patch) {
                    const auto at = nearest_point(shape, patch, x);
                    // No sample is nearer, one is nearly as near, and the point is on the surface.
                    const double sampled = sampled_distance(surfaces[patch], x);
                    CHECK(at.distance <= sampled + 1e-12);
                    CHECK(at.distance >= sampled - resolution);
                    CHECK(sampled_distance(surfaces[patch], at.point) <= resolution);
                }
            }
        }
    }
}

TEST_CASE("the normal leads from the nearest point to the place asked for", "[wall]")
{
    Random random(2);
    for (const auto& [name, shape, surfaces] : shapes)
        for (int k = 0; k < 20; ++k) {
            const Vec3 x = random_place(random);
            const auto at = nearest_point(shape, 0, x);
            CAPTURE(name, x.transpose());
            CHECK(at.normal.norm() == Approx(1.0));
            CHECK((at.point + at.distance * at.normal - x).norm() < 1e-14);
        }
}

TEST_CASE("a turned shape has the turned nearest point", "[wall]")
{
    using MakeShape = Sampled (*)(const Placement&);
    const MakeShape make = GENERATE(MakeShape(tube), MakeShape(funnel), MakeShape(point_down), MakeShape(plate),
        MakeShape(plate_with_hole), MakeShape(triangle));
    const auto straight = make(in_place), askew = make(turned());
    INFO(straight.name);
    Random random(3);
    for (int k = 0; k < 100; ++k) {
        const Vec3 x = random_place(random);
        const auto here = nearest_point(straight.shape, 0, x);
        const auto there = nearest_point(askew.shape, 0, turned() * x);
        CHECK((there.point - turned() * here.point).norm() < 1e-14);
        CHECK((there.normal - turned().linear() * here.normal).norm() < 1e-12);
        CHECK(there.distance == Approx(here.distance).epsilon(1e-13));
    }
}

TEST_CASE("behind a plane the distance is negative and the normal still points to the free side", "[wall]")
{
    const Vec3 normal = Vec3(1, 2, 2) / 3.0;
    const Shape plane = Plane{Vec3(1, 0, 0), normal};
    const auto behind = nearest_point(plane, 0, Vec3(1, 0, 0) - 0.25 * normal);
    CHECK(behind.distance == Approx(-0.25));
    CHECK(behind.normal == normal);
    CHECK((behind.point - Vec3(1, 0, 0)).norm() < 1e-15);
    CHECK(nearest_point(plane, 0, Vec3(1, 0, 0) + 0.25 * normal).distance == Approx(0.25));
}

TEST_CASE("a point on a thin wall, or on its axis, has a unit normal", "[wall][degenerate]")
{
    for (const auto& [name, shape, surfaces] : shapes) {
        CAPTURE(name);
        const auto on_wall = nearest_point(shape, 0, surfaces[0](0.5, 0.25));
        CHECK(on_wall.distance < 1e-15);
        CHECK(on_wall.normal.norm() == Approx(1.0));
        CHECK(nearest_point(shape, 0, Vec3::Zero()).normal.norm() == Approx(1.0));
        CHECK(nearest_point(shape, 0, turned() * Vec3::Zero()).normal.norm() == Approx(1.0));
    }
}

TEST_CASE("every patch that comes within a sphere is near the box round it", "[wall]")
{
    auto all = shapes;
    all.push_back({"plane", Plane{Vec3::Zero(), Vec3(1, 2, 2) / 3.0}, {}});
    Random random(4);
    std::size_t within = 0;
    for (const auto& [name, shape, surfaces] : all)
        for (int k = 0; k < 200; ++k) {
            const Vec3 x = random_place(random);
            const double radius = uniform(random);
            std::vector<std::int32_t> near;
            patches_near(shape, Box{x, x}.grown(radius), near);
            CHECK(std::is_sorted(near.begin(), near.end()));
            for (std::size_t patch = 0; patch < patch_count(shape); ++patch) {
                if (nearest_point(shape, patch, x).distance > radius) continue;
                ++within;
                CAPTURE(name, x.transpose(), radius, patch);
                CHECK(std::binary_search(near.begin(), near.end(), static_cast<std::int32_t>(patch)));
            }
        }
    CHECK(within > 200);
}

TEST_CASE("the bounds of a shape hold its surface, and no smaller box does", "[wall]")
{
    for (const auto& [name, shape, surfaces] : shapes) {
        CAPTURE(name);
        Box sampled;
        for (const auto& surface : surfaces)
            for (int i = 0; i <= samples; ++i)
                for (int j = 0; j <= samples; ++j) sampled.extend(surface(double(i) / samples, double(j) / samples));
        const Box box = bounds(shape);
        CHECK(box.grown(1e-12).contains(sampled));
        CHECK(sampled.grown(resolution).contains(box));
    }
    CHECK(bounds(Plane{}).empty());
}

TEST_CASE("a box of panels has the faces that are not open", "[wall]")
{
    const Box box{Vec3(0, 0, 0), Vec3(1, 2, 3)};
    const Shape closed = box_panels(box, {});
    CHECK(patch_count(closed) == 6);
    const Shape tray = box_panels(box, {"z+", "x-"});
    CHECK(patch_count(tray) == 4);
    CHECK_FALSE(bounds(tray).empty());
    const auto distance = [&](const Vec3& x) {
        double least = infinity;
        for (std::size_t k = 0; k < patch_count(tray); ++k) least = std::min(least, nearest_point(tray, k, x).distance);
        return least;
    };
    CHECK(distance(Vec3(0.9, 1, 1.5)) == Approx(0.1)); // x+ stands
    CHECK(distance(Vec3(0.2, 1, 2.9)) == Approx(0.8)); // neither x- nor z+ does
}

TEST_CASE("a wall stands from when it appears until it is removed", "[wall]")
{
    const Wall gate{"gate", Plane{}, 0, 1.0, 2.0};
    CHECK_FALSE(gate.stands_at(0.999));
    CHECK(gate.stands_at(1.0));
    CHECK(gate.stands_at(1.999));
    CHECK_FALSE(gate.stands_at(2.0));
}
