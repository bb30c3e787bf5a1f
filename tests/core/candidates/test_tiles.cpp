// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/candidates/neighbor_search.hpp"
#include "core/candidates/tiles.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

using namespace talus;

namespace
{

/// Places in a box of this size around the origin, so that indices of both signs occur.
std::vector<Vec3> random_places(std::size_t count, const Vec3& size, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < count; ++i)
        places.push_back(
            size.cwiseProduct(Vec3(uniform(random), uniform(random), uniform(random)) - Vec3::Constant(0.5)));
    return places;
}

/// The tile of each sphere.
std::vector<std::size_t> tile_of_sphere(const Tiles& tiles, std::size_t count)
{
    std::vector<std::size_t> tile(count);
    for (std::size_t t = 0; t < tiles.count(); ++t)
        for (auto k = tiles.first[t]; k < tiles.first[t + 1]; ++k) tile[static_cast<std::size_t>(tiles.spheres[k])] = t;
    return tile;
}

} // namespace

TEST_CASE("each sphere is in exactly one tile, and each tile has one and a colour", "[tiles]")
{
    const auto count = GENERATE(as<std::size_t>{}, 1, 5, 1000);
    const auto edge = GENERATE(0.07, 0.5, 10.0);
    const auto tiles = make_tiles(random_places(count, Vec3(2, 1, 3), 1), edge);
    std::vector<std::int32_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    auto spheres = tiles.spheres;
    std::sort(spheres.begin(), spheres.end());
    CHECK(spheres == all);
    REQUIRE(tiles.first.front() == 0);
    CHECK(tiles.first.back() == count);
    for (std::size_t t = 0; t < tiles.count(); ++t) {
        CHECK(tiles.first[t] < tiles.first[t + 1]);
        CHECK(std::is_sorted(tiles.spheres.begin() + tiles.first[t], tiles.spheres.begin() + tiles.first[t + 1]));
    }
    CHECK(tiles.color_first.front() == 0);
    CHECK(std::is_sorted(tiles.color_first.begin(), tiles.color_first.end()));
    CHECK(tiles.color_first.back() == tiles.count());
}

TEST_CASE("two tiles of one colour share no sphere through the pairs that they own", "[tiles]")
{
    const auto seed = GENERATE(1u, 2u, 3u, 4u);
    const auto size = GENERATE(Vec3(8, 8, 8), Vec3(30, 2, 10), Vec3(1, 1, 200));
    const auto places = random_places(800, size, seed);
    std::vector<Box> boxes;
    for (const auto& x : places) boxes.push_back(Box{x, x}.grown(0.5));
    const auto pairs = find_box_pairs(boxes);
    double farthest = 0.0;
    for (const auto& [a, b] : pairs)
        farthest = std::max(farthest,
            (places[static_cast<std::size_t>(a)] - places[static_cast<std::size_t>(b)]).lpNorm<Eigen::Infinity>());

    const auto tiles = make_tiles(places, 2.001 * farthest);
    REQUIRE(tiles.count() > Tiles::colors);
    const auto tile = tile_of_sphere(tiles, places.size());
    for (std::size_t color = 0; color < Tiles::colors; ++color) {
        std::map<std::int32_t, std::size_t> user; // the tile that moves a sphere while this colour has its turn
        bool shared = false;
        for (const auto& [a, b] : pairs) {
            const auto owner = tile[static_cast<std::size_t>(a)];
            if (owner < tiles.color_first[color] || owner >= tiles.color_first[color + 1]) continue;
            for (const auto i : {a, b}) shared = shared || user.try_emplace(i, owner).first->second != owner;
        }
        CHECK_FALSE(shared);
    }
}

TEST_CASE("no spheres have no tiles", "[tiles][degenerate]")
{
    const auto tiles = make_tiles({}, 1.0);
    CHECK(tiles.count() == 0);
    CHECK(tiles.color_first.back() == 0);
}

TEST_CASE("spheres that lie millions of tiles apart are still told apart", "[tiles][degenerate]")
{
    const auto tiles = make_tiles({Vec3::Zero(), Vec3(1e9, 0, 0), Vec3(0, -1e9, 0), Vec3(0, 0, 1e9)}, 0.01);
    CHECK(tiles.count() == 4);
}
