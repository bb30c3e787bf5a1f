// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/world/placed_wall.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace talus;

namespace
{

Mesh roof()
{
    return make_mesh({Vec3(0, 0, 0), Vec3(0.3, 0, 0.1), Vec3(0.3, 0.4, 0.1), Vec3(0, 0.4, 0), Vec3(0.5, 0.1, -0.2)},
        {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}});
}

const std::vector<Shape> shapes = {Plane{Vec3(0, 0, 0.1), Vec3(0, 0.6, 0.8)},
    Cylinder{Vec3(0.1, 0, 0), Vec3(0.6, 0, 0.8), 0.2, 0.5}, Cone{Vec3(0, 0.1, 0), Vec3::UnitY(), 0.1, 0.3, 0.4},
    Disk{Vec3(0.1, 0.2, 0.3), Vec3(0, 0.6, 0.8), 0.3, 0.1}, box_panels({Vec3::Zero(), Vec3(0.3, 0.4, 0.2)}, {"z+"}),
    roof(), grain_bed({Vec3::Zero(), Vec3(0.4, 0.3, 0.1)}, 0.05, 0.06)};

const WallMotion tumbling = {
    Turning{{}, Vec3(0.1, 0.2, 0), Vec3(2, 1, -2) / 3.0, 0.9}, Translation{{}, Vec3(0.1, -0.2, 0.05)}};

Vec3 random_place(Random& random)
{
    return Vec3(uniform(random), uniform(random), uniform(random)) * 2.0 - Vec3::Ones();
}

Wall moving_wall(const Shape& shape)
{
    Wall wall{"wall", shape};
    wall.motion = tumbling;
    return wall;
}

double least_distance(const Shape& shape, const Vec3& x)
{
    double least = infinity;
    for (std::size_t k = 0; k < patch_count(shape); ++k) least = std::min(least, nearest_point(shape, k, x).distance);
    return least;
}

std::vector<std::int32_t> patches_in(const PlacedWall& wall, const Box& box)
{
    std::vector<std::int32_t> patches;
    wall.patches_near(box, patches);
    return patches;
}

/// Requires that every patch whose nearest point to the middle of a cube lies in it is among those found, in order and
/// once.
void check_complete(const PlacedWall& wall, const Vec3& x, double half)
{
    const auto found = patches_in(wall, Box{x, x}.grown(half));
    CHECK(std::is_sorted(found.begin(), found.end()));
    CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
    for (std::size_t k = 0; k < wall.patch_count(); ++k) {
        const auto at = wall.nearest_point(k, x);
        CHECK(at.patch == static_cast<std::int32_t>(k));
        if (at.distance < half) CHECK(std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(k)));
    }
}

Periodicity cell(const Vec3& origin, const Vec3& length)
{
    return {origin, length};
}

} // namespace

TEST_CASE("a wall that has moved is seen as the shape is from where the point would be before", "[placed_wall]")
{
    const auto index = GENERATE(range<std::size_t>(0, 7));
    const double time = GENERATE(0.0, 0.7, 5.0);
    const Wall wall = moving_wall(shapes[index]);
    const PlacedWall placed_wall(wall, {}, time, 1e-3);
    const Pose pose = pose_at(tumbling, time);
    REQUIRE(placed_wall.patch_count() == patch_count(wall.shape));
    Random random(index);
    for (int trial = 0; trial < 30; ++trial) {
        const Vec3 own = random_place(random), x = pose(own);
        for (std::size_t k = 0; k < placed_wall.patch_count(); ++k) {
            const auto expected = nearest_point(wall.shape, k, own);
            const auto at = placed_wall.nearest_point(k, x);
            CHECK(at.distance == Approx(expected.distance).margin(1e-12));
            CHECK((at.point - pose(expected.point)).norm() < 1e-9);
            CHECK((at.normal - pose.rotation * expected.normal).norm() < 1e-9);
        }
        check_complete(placed_wall, x, 0.2);
        const double gap = least_distance(wall.shape, own) - 0.1;
        CHECK(placed_wall.gap(x, 0.1, 5.0) == Approx(gap).margin(1e-12));
        CHECK(placed_wall.gap(x, 0.1, gap - 1e-9) == infinity);
        CHECK(placed_wall.gap(x, 0.1, gap + 1e-9) == Approx(gap).margin(1e-12));
    }
}

TEST_CASE("the velocity of a wall is that of its material over the step", "[placed_wall]")
{
    const Wall wall = moving_wall(shapes[4]);
    const double h = 1e-4, time = 0.6;
    const PlacedWall now(wall, {}, time, h);
    const Pose before = pose_at(tumbling, time), after = pose_at(tumbling, time + h);
    const Vec3 own(0.3, 0.4, 0.1);
    CHECK((now.velocity(0, before(own)) - (after(own) - before(own)) / h).norm() < 1e-4); // first order in h
    const Pose long_before = pose_at(tumbling, time - h);
    CHECK((now.velocity_before(0, before(own)) - (before(own) - long_before(own)) / h).norm() < 1e-4);
    CHECK((now.velocity_before(0, before(own)) - now.velocity(0, before(own))).norm() > 2e-5); // it turns
    const PlacedWall begun(wall, {}, 0.0, h); // there was no step before
    CHECK(begun.velocity_before(0, own) == begun.velocity(0, own));
    CHECK((now.spin() - 0.9 * Vec3(2, 1, -2) / 3.0).norm() < 1e-10);
    const Box around{Vec3(-1, -1, -1), Vec3(1, 2, 1)};
    double fastest = 0.0;
    Random random(3);
    for (int k = 0; k < 200; ++k) {
        const Vec3 x =
            around.min + Vec3(uniform(random), uniform(random), uniform(random)).cwiseProduct(around.extent());
        fastest = std::max(fastest, now.velocity(0, x).norm());
    }
    CHECK(fastest <= now.fastest(around));
    CHECK(fastest > 0.7 * now.fastest(around));
    CHECK(PlacedWall(wall, {}, time).velocity(0, own) == Vec3::Zero()); // only the place was wanted
}

TEST_CASE("a wall is there once for each neighbouring cell, and its material moves alike in all", "[placed_wall]")
{
    const auto index = GENERATE(range<std::size_t>(1, 7));
    const auto periodicity = GENERATE(
        cell(Vec3(-0.5, 0, 0), Vec3(1.1, infinity, infinity)), cell(Vec3(-0.5, 0, -0.4), Vec3(1.1, infinity, 1.3)));
    const Wall wall = moving_wall(shapes[index]);
    const PlacedWall alone(wall, {}, 0.8, 1e-3), all(wall, periodicity, 0.8, 1e-3);
    const auto shifts = periodicity.neighbor_shifts();
    REQUIRE(all.patch_count() == shifts.size() * alone.patch_count());
    REQUIRE(shifts.size() == (periodicity.along(2) ? 9 : 3));
    Random random(index);
    for (int trial = 0; trial < 20; ++trial) {
        const Vec3 x = random_place(random);
        double least = infinity;
        for (const Vec3& shift : shifts) least = std::min(least, alone.gap(x - shift, 0.1, 9.0));
        CHECK(all.gap(x, 0.1, 9.0) == Approx(least).margin(1e-12));
        check_complete(all, x, 0.3);
        for (std::size_t k = 0; k < all.patch_count(); ++k) {
            const Vec3& shift = shifts[k / alone.patch_count()];
            const auto at = all.nearest_point(k, x), own = alone.nearest_point(k % alone.patch_count(), x - shift);
            CHECK((at.point - own.point - shift).norm() < 1e-12);
            CHECK((all.velocity(k, x) - alone.velocity(k % alone.patch_count(), x - shift)).norm() < 1e-12);
            CHECK(all.velocity(k, x).norm() <= all.fastest(Box{x, x}) + 1e-12); // whichever image it is
        }
    }
}

TEST_CASE("a plane along periodic axes is its own image", "[placed_wall]")
{
    const Wall wall{"floor", Plane{Vec3::Zero(), Vec3::UnitZ()}};
    const PlacedWall placed_wall(wall, cell(Vec3::Zero(), Vec3(1, 1, infinity)), 0.0);
    CHECK(placed_wall.patch_count() == 1);
    CHECK(placed_wall.gap(Vec3(0.2, 7, 0.3), 0.1, 1.0) == Approx(0.2));
}

TEST_CASE("a wall stands in its time only", "[placed_wall]")
{
    Model model;
    Wall& wall = model.walls.emplace_back(Wall{"gate", Plane{}});
    wall.appear_at = 1.0;
    wall.remove_at = 2.0;
    const auto touches = [&](double time) {
        State state;
        state.time = time;
        return touches_wall(place_walls(model, state), Vec3(0, 0, 0.1), 0.2);
    };
    CHECK_FALSE(touches(0.5));
    CHECK(touches(1.0));
    CHECK_FALSE(touches(2.0));
}

TEST_CASE("no point of a box makes a longer way than its corners", "[placed_wall]")
{
    const Box box{Vec3(-0.3, 0, 0), Vec3(1, 0.5, 2)};
    const Pose from = pose_at(tumbling, 0.4), to = pose_at(tumbling, 0.6);
    const double longest = longest_way(from, to, box);
    Random random(5);
    double seen = 0.0;
    for (int k = 0; k < 500; ++k) {
        const Vec3 x = box.min + Vec3(uniform(random), uniform(random), uniform(random)).cwiseProduct(box.extent());
        seen = std::max(seen, (to(from.inverse()(x)) - x).norm());
    }
    CHECK(seen <= longest);
    CHECK(seen > 0.8 * longest);
}

TEST_CASE("a grain is nearest along the line of centres, from inside too", "[grains]")
{
    const Shape grain = Grains{{Vec3(1, 2, 3)}, 0.5};
    const auto outside = nearest_point(grain, 0, Vec3(1, 2, 4));
    CHECK(outside.distance == 0.5);
    CHECK(outside.normal == Vec3::UnitZ());
    CHECK(outside.point == Vec3(1, 2, 3.5));
    const auto inside = nearest_point(grain, 0, Vec3(1, 2.25, 3));
    CHECK(inside.distance == -0.25);
    CHECK(inside.normal == Vec3::UnitY());
    const auto middle = nearest_point(grain, 0, Vec3(1, 2, 3));
    CHECK(middle.distance == -0.5);
    CHECK(middle.normal.norm() == 1.0);
}

TEST_CASE("a bed of grains fills its box with jittered layers, ordered along x, always the same", "[grains]")
{
    const Box box{Vec3(0.1, 0.2, 0.3), Vec3(1.1, 0.8, 0.3)};
    const double spacing = 0.1;
    const auto bed = grain_bed(box, 0.08, spacing);
    CHECK(bed.radius == 0.04);
    CHECK(bed.centers.size() == 10 * 6); // flat along z: one layer
    CHECK(std::is_sorted(
        bed.centers.begin(), bed.centers.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); }));
    CHECK(bed.centers == grain_bed(box, 0.08, spacing).centers);
    double jitter = 0.0;
    Box around;
    for (const Vec3& x : bed.centers) {
        around.extend(x);
        for (int d = 0; d < 2; ++d) {
            const double cells = (x[d] - box.min[d]) / spacing;
            jitter = std::max(jitter, spacing * std::abs(cells - std::floor(cells) - 0.5));
        }
        jitter = std::max(jitter, std::abs(x.z() - 0.3));
    }
    CHECK(jitter <= spacing / 3.0 + 1e-12);
    CHECK(jitter > 0.9 * spacing / 3.0);
    const Box whole = bounds(bed);
    CHECK((whole.min - around.grown(0.04).min).norm() == 0.0);
    CHECK((whole.max - around.grown(0.04).max).norm() == 0.0);
}
