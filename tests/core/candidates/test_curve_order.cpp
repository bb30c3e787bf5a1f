// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/curve_order.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace talus;

TEST_CASE("Hilbert's curve goes from each cube to one beside it, and through every one", "[curve_order]")
{
    // A block of 16 x 16 x 16 cubes whose edges are where those of the curve's own blocks of this size are.
    constexpr int size = 16;
    const Vec3 corner = GENERATE(Vec3(0, 0, 0), Vec3(-0.7, 3, 100)),
               first = GENERATE(Vec3(0, 0, 0), Vec3(-16, 32, -48));
    constexpr double edge = 0.25;
    std::vector<std::pair<std::uint64_t, Vec3>> cubes;
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int z = 0; z < size; ++z) {
                const Vec3 cube = first + Vec3(x, y, z);
                cubes.emplace_back(curve_key(corner + edge * (cube + Vec3(0.5, 0.1, 0.9)), corner, edge), cube);
            }
    std::ranges::sort(cubes, {}, [](const auto& cube) { return cube.first; });
    bool in_a_row = true, beside = true;
    for (std::size_t k = 1; k < cubes.size(); ++k) {
        in_a_row = in_a_row && cubes[k].first == cubes[k - 1].first + 1;
        beside = beside && (cubes[k].second - cubes[k - 1].second).lpNorm<1>() == 1.0;
    }
    CHECK(in_a_row);
    CHECK(beside);
}

TEST_CASE("spheres come in the order of their keys, and of their ids in one cube", "[curve_order]")
{
    CHECK(curve_order({7, 3, 7, 3, 0}, {4, 9, 2, 1, 5}) == std::vector<std::int32_t>{4, 2, 3, 1, 0});
    CHECK(curve_order({}, {}).empty());
}

TEST_CASE("the outermost cubes have no end", "[curve_order][degenerate]")
{
    const auto key = [](double x) { return curve_key(Vec3(x, 0, 0), Vec3::Zero(), 1.0); };
    CHECK(key(1e9) == key(1e300));
    CHECK(key(-1e9) == key(-1e300));
    CHECK(key(-1e9) != key(1e9));
}
