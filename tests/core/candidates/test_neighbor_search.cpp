// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/candidates/neighbor_search.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace talus;

namespace
{

/// Boxes round spheres of radii between 1 and `size_ratio`, dense enough that each meets a few others.
std::vector<Box> random_boxes(std::size_t count, double size_ratio, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> radius(count);
    double volume = 0.0;
    for (auto& r : radius) {
        r = 1.0 + (size_ratio - 1.0) * uniform(random);
        volume += r * r * r;
    }
    const double edge = 2.0 * std::cbrt(volume);
    std::vector<Box> boxes;
    for (const double r : radius) {
        const Vec3 x = edge * Vec3(uniform(random), uniform(random), uniform(random));
        boxes.push_back(Box{x, x}.grown(r));
    }
    return boxes;
}

std::vector<IndexPair> sorted(std::vector<IndexPair> pairs)
{
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace

TEST_CASE("neighbor search finds the pairs that brute force finds", "[neighbor_search]")
{
    const auto count = GENERATE(as<std::size_t>{}, 2, 10, 29, 31, 200, 2000);
    const auto size_ratio = GENERATE(1.0, 3.0, 20.0);
    const auto seed = GENERATE(1u, 2u, 3u);
    CAPTURE(count, size_ratio, seed);
    const auto boxes = random_boxes(count, size_ratio, seed);
    const auto expected = find_box_pairs_brute_force(boxes);
    if (count >= 200) REQUIRE(expected.size() > count / 4); // not a test of nothing
    CHECK(sorted(find_box_pairs(boxes)) == expected);
}

TEST_CASE("a search in several slabs finds each pair once", "[neighbor_search]")
{
    const double longest = GENERATE(infinity, 60.0); // of the cell, along x
    constexpr std::size_t count = 17000;
    auto boxes = random_boxes(count, 3.0, 5);
    const Periodicity periodicity{.length = Vec3(longest, infinity, infinity)};
    const auto expected = find_box_pairs_brute_force(boxes, periodicity);
    REQUIRE(expected.size() > count);
    CHECK(sorted(find_box_pairs(boxes, periodicity)) == expected);
    std::vector<std::int32_t> movers;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); i += 2) movers.push_back(i);
    auto some = expected;
    std::erase_if(some, [](const IndexPair& pair) { return pair.a % 2 != 0 && pair.b % 2 != 0; });
    CHECK(sorted(find_box_pairs(boxes, movers, periodicity)) == some);
}

TEST_CASE("a search for some boxes finds each pair that has one of them, once", "[neighbor_search]")
{
    const auto count = GENERATE(as<std::size_t>{}, 2, 30, 500, 2000);
    const auto size_ratio = GENERATE(1.0, 20.0);
    const auto every = GENERATE(1, 2, 50);
    CAPTURE(count, size_ratio, every);
    const auto boxes = random_boxes(count, size_ratio, 4);
    std::vector<std::int32_t> movers;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); i += every) movers.push_back(i);

    std::vector<IndexPair> expected;
    for (const auto& pair : find_box_pairs_brute_force(boxes))
        if (pair.a % every == 0 || pair.b % every == 0) expected.push_back(pair);
    CHECK(sorted(find_box_pairs(boxes, movers)) == expected);
    std::reverse(movers.begin(), movers.end());
    CHECK(sorted(find_box_pairs(boxes, movers)) == expected);
}

TEST_CASE("no boxes and one box have no pairs", "[neighbor_search][degenerate]")
{
    const std::vector<Box> none;
    const std::vector<std::int32_t> no_movers;
    CHECK(find_box_pairs(none).empty());
    CHECK(find_box_pairs(none, no_movers).empty());
    const std::vector<Box> one = {Box{Vec3::Zero(), Vec3::Ones()}};
    CHECK(find_box_pairs(one).empty());
    CHECK(find_box_pairs(one, std::vector<std::int32_t>{0}).empty());
    CHECK(find_box_pairs(one, no_movers).empty());
}

TEST_CASE("boxes round one centre all meet", "[neighbor_search][degenerate]")
{
    const std::size_t count = GENERATE(2, 100); // below and above CGAL's cutoff
    const std::vector<Box> boxes(count, Box{Vec3::Zero(), Vec3::Ones()});
    CHECK(find_box_pairs(boxes).size() == count * (count - 1) / 2);
    CHECK(sorted(find_box_pairs(boxes)) == find_box_pairs_brute_force(boxes));
    CHECK(find_box_pairs(boxes, {1}).size() == count - 1);
}

TEST_CASE("boxes that just touch meet, at faces, edges and corners", "[neighbor_search][degenerate]")
{
    // A block of unit cubes: an inner one touches all 26 around it.
    std::vector<Box> boxes;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            for (int k = 0; k < 6; ++k) boxes.push_back({Vec3(i, j, k), Vec3(i + 1, j + 1, k + 1)});
    // Along each axis 16 ordered pairs of indices differ by at most 1, of 36; less the 216 cubes with themselves.
    CHECK(find_box_pairs(boxes).size() == (16 * 16 * 16 - 216) / 2);
    CHECK(sorted(find_box_pairs(boxes)) == find_box_pairs_brute_force(boxes));
}
