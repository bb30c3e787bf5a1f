// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/world/wall.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace talus;

namespace
{

Vec3 random_place(Random& random)
{
    return {uniform(random), uniform(random), uniform(random)};
}

/// Triangles of this size at random places and in random attitudes.
Mesh random_mesh(int count, double size, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Vec3> vertices;
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (std::int32_t t = 0; t < count; ++t) {
        const Vec3 center = random_place(random);
        for (int k = 0; k < 3; ++k) vertices.push_back(center + size * (random_place(random) - Vec3::Constant(0.5)));
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return make_mesh(vertices, triangles);
}

Box bounds_of(const Mesh& mesh, std::size_t triangle)
{
    Box box;
    for (const auto k : mesh.triangles[triangle]) box.extend(mesh.vertices[static_cast<std::size_t>(k)]);
    return box;
}

} // namespace

TEST_CASE("a box finds every triangle within its inner sphere and none whose bounds it misses", "[triangle_tree]")
{
    const auto size = GENERATE(0.02, 0.3, 2.0);
    const Shape shape = random_mesh(300, size, 1);
    const auto& mesh = std::get<Mesh>(shape);
    Random random(2);
    std::size_t hits = 0;
    for (int query = 0; query < 100; ++query) {
        const Vec3 x = random_place(random);
        const double radius = 0.2 * uniform(random);
        const Box box = Box{x, x}.grown(radius);
        std::vector<std::int32_t> found;
        patches_near(shape, box, found);
        REQUIRE(std::is_sorted(found.begin(), found.end()));
        REQUIRE(std::adjacent_find(found.begin(), found.end()) == found.end());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const bool is_found = std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(t));
            if (nearest_point(shape, t, x).distance <= radius) CHECK(is_found);
            if (!bounds_of(mesh, t).meets(box)) CHECK_FALSE(is_found);
            hits += is_found;
        }
    }
    CHECK(hits > 100);
}

TEST_CASE("a triangle wholly inside the box, and one that the box lies inside, are found", "[triangle_tree]")
{
    const Shape shape = make_mesh(
        {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(-90, -90, 1), Vec3(90, -90, 1), Vec3(0, 90, 1)},
        {{0, 1, 2}, {3, 4, 5}});
    const auto found_in = [&](const Box& box) {
        std::vector<std::int32_t> found;
        patches_near(shape, box, found);
        return found;
    };
    CHECK(found_in({Vec3::Constant(-0.5), Vec3::Constant(0.5)}) == std::vector<std::int32_t>{0});
    CHECK(found_in({Vec3(-0.5, -0.5, 0.9), Vec3(0.5, 0.5, 1.1)}) == std::vector<std::int32_t>{1});
    CHECK(found_in({Vec3(-0.5, -0.5, 0.5), Vec3(0.5, 0.5, 0.9)}).empty());
    CHECK(found_in({Vec3::Constant(-2), Vec3::Constant(2)}) == std::vector<std::int32_t>{0, 1});
}

TEST_CASE("triangles are appended to what was found before", "[triangle_tree]")
{
    const Shape shape = make_mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
    std::vector<std::int32_t> found = {7};
    patches_near(shape, {Vec3::Constant(-1), Vec3::Constant(1)}, found);
    CHECK(found == std::vector<std::int32_t>{7, 0});
}

TEST_CASE("triangles without area are dropped from a mesh", "[triangle_tree]")
{
    const auto mesh =
        make_mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}, {0, 1, 3}, {0, 0, 3}});
    CHECK(mesh.triangles == std::vector<std::array<std::int32_t, 3>>{{0, 1, 3}});
}
