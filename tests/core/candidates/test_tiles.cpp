// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/candidates/neighbor_search.hpp"
#include "core/candidates/tiles.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

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

} // namespace

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

    const TileGrid grid(2.001 * farthest, {}, Vec3(0.3, -7, 0));
    std::set<std::uint64_t> cells;
    bool shared = false;
    std::map<std::pair<std::size_t, std::int32_t>, std::uint64_t> user; // of a sphere while a colour has its turn
    for (const auto& [a, b] : pairs) {
        const auto cell = grid.cell(places[static_cast<std::size_t>(a)]);
        cells.insert(cell);
        for (const auto i : {a, b})
            shared = shared || user.try_emplace({TileGrid::color(cell), i}, cell).first->second != cell;
    }
    CHECK(cells.size() > Tiles::colors);
    CHECK_FALSE(shared);
}

TEST_CASE("a place lies in the cell of its cube, wherever the spheres are", "[tiles]")
{
    const Vec3 corner = GENERATE(Vec3(0, 0, 0), Vec3(1e6, -3, 0.1));
    constexpr double edge = 0.5;
    const TileGrid grid(edge, {}, corner);
    std::map<std::tuple<int, int, int>, std::uint64_t> cell_of;
    std::map<std::uint64_t, std::tuple<int, int, int>> cube_of;
    for (const auto& x : random_places(2000, Vec3(4, 4, 4), 3)) {
        const Vec3 along = ((corner + x - corner) / edge).array().floor();
        const std::tuple cube{static_cast<int>(along[0]), static_cast<int>(along[1]), static_cast<int>(along[2])};
        const auto cell = grid.cell(corner + x);
        CHECK(cell_of.try_emplace(cube, cell).first->second == cell);
        CHECK(cube_of.try_emplace(cell, cube).first->second == cube);
        const auto odd = [](int k) { return static_cast<std::size_t>(k & 1); };
        CHECK(
            TileGrid::color(cell) == odd(std::get<0>(cube)) + 2 * odd(std::get<1>(cube)) + 4 * odd(std::get<2>(cube)));
    }
}

TEST_CASE("tiles are opened for cells that have none, in the order of their colours", "[tiles]")
{
    const TileGrid grid(1.0, {}, Vec3::Zero());
    const auto cell = [&](double x, double y) { return grid.cell(Vec3(x + 0.5, y + 0.5, 0.5)); };
    Tiles tiles;
    CHECK(tiles.count() == 0);
    tiles.open({cell(3, 0), cell(0, 0), cell(3, 0), cell(2, 4)});
    REQUIRE(tiles.count() == 3);
    CHECK(tiles.color_first == std::array<std::uint32_t, 9>{0, 2, 3, 3, 3, 3, 3, 3, 3});
    const auto tile = [&](double x, double y) -> Tile& {
        return tiles.tiles[static_cast<std::size_t>(tiles.of_cell(cell(x, y)))];
    };
    tile(3, 0).pairs = {{4, 7}};
    tiles.open({cell(0, 0)}); // is there: nothing happens
    CHECK(tiles.count() == 3);
    tiles.open({cell(0, 0), cell(5, 5)});
    CHECK(tiles.count() == 3); // (2, 4) was empty and not asked for
    CHECK(tiles.of_cell(cell(2, 4)) == -1);
    CHECK(tile(3, 0).pairs == std::vector<IndexPair>{{4, 7}});
    CHECK(tile(5, 5).pairs.empty());
    CHECK(std::is_sorted(tiles.cells.begin(), tiles.cells.end()));
    CHECK(tiles.color_first == std::array<std::uint32_t, 9>{0, 1, 2, 2, 3, 3, 3, 3, 3});
}

TEST_CASE("the outermost cells have no end", "[tiles][degenerate]")
{
    const TileGrid grid(0.01, {}, Vec3::Zero());
    CHECK(grid.cell(Vec3(1e9, 0, 0)) == grid.cell(Vec3(1e300, 0, 0)));
    CHECK(grid.cell(Vec3(1e9, 0, 0)) != grid.cell(Vec3(-1e9, 0, 0)));
    CHECK(grid.cell(Vec3(1e9, 0, 0)) != grid.cell(Vec3(0, 0, 1e9)));
}
