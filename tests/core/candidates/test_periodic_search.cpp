// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/candidates/neighbor_search.hpp"
#include "core/candidates/tiles.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>

using namespace talus;

namespace
{

/// Cells of boxes of edge 1 to 2: long and short ones, one to three periodic axes, not at the origin.
const std::vector<Periodicity> cells = {
    {Vec3(-3, 0, 0), Vec3(12, infinity, infinity)},
    {Vec3(0, 5, 0), Vec3(infinity, 8, infinity)},
    {Vec3(0, 0, -20), Vec3(infinity, infinity, 8)},
    {Vec3(-4, -4, 0), Vec3(8, 8, infinity)},
    {Vec3(1, 0, 2), Vec3(9, infinity, 31)},
    {Vec3(1, -3, 2), Vec3(8, 12, 9)},
};

constexpr double free_length = 10.0;

std::vector<Vec3> random_places(std::size_t count, const Periodicity& periodicity, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 x = periodicity.origin;
        for (int d = 0; d < 3; ++d)
            x[d] += uniform(random) * (periodicity.along(d) ? periodicity.length[d] : free_length);
        places.push_back(x);
    }
    return places;
}

/// Boxes round places in the cell, which reach out of it, some of them drawn out along a way.
std::vector<Box> random_boxes(const std::vector<Vec3>& places, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Box> boxes;
    for (const Vec3& x : places) {
        const Vec3 way = Vec3(uniform(random), uniform(random), uniform(random)) - Vec3::Constant(0.5);
        boxes.push_back(Box{x, x}.extend(Vec3(x + 2.0 * way)).grown(0.5));
    }
    return boxes;
}

/// Whether two boxes meet, by all images up to two cells away and one coordinate after the other.
bool meet(const Box& a, const Box& b, const Periodicity& periodicity)
{
    for (int d = 0; d < 3; ++d) {
        bool along = false;
        for (int cell = -2; cell <= 2; ++cell) {
            const double shift = periodicity.along(d) ? cell * periodicity.length[d] : 0.0;
            along = along || (a.min[d] <= b.max[d] + shift && b.min[d] + shift <= a.max[d]);
        }
        if (!along) return false;
    }
    return true;
}

std::vector<IndexPair> sorted(std::vector<IndexPair> pairs)
{
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace

TEST_CASE("wrapped places lie in the cell, a whole number of cells away", "[periodicity]")
{
    const Periodicity cell{Vec3(-0.3, 0, 5), Vec3(0.7, infinity, 2)};
    for (const double x : {-100.0, -0.3, -0.3 - 1e-18, -0.3 + 0.7, 0.1, 3.0, std::nextafter(0.4, 0.0)}) {
        const Vec3 inside = cell.wrapped(Vec3(x, -9, 6.9));
        CHECK(inside.x() >= -0.3);
        CHECK(inside.x() < -0.3 + 0.7);
        const double away = (inside.x() - x) / 0.7;
        CHECK(away == Approx(std::round(away)).margin(1e-12));
        CHECK(inside.y() == -9);
        CHECK(inside.z() == 6.9);
    }
    CHECK(cell.nearest_image(Vec3(0.6, 8, -1.2)).isApprox(Vec3(-0.1, 8, 0.8)));
    CHECK(cell.shift_towards(Vec3(0.3, 0, 5), Vec3(-0.2, 7, 12)).isApprox(Vec3(-0.7, 0, 8)));
}

TEST_CASE("boxes are as far apart as their nearest images, in short cells too", "[periodicity]")
{
    const Periodicity cell{Vec3::Zero(), Vec3(2.2, infinity, 7)};
    Random random(1);
    const auto number = [&] { return 8.0 * uniform(random) - 4.0; };
    for (int k = 0; k < 1000; ++k) {
        const auto box = [&] {
            const Vec3 x(number(), number(), number());
            return Box{x, x}.extend(Vec3(x + 0.3 * Vec3(number(), number(), number())));
        };
        const Box a = box(), b = box();
        Vec3 nearest = Vec3::Constant(infinity);
        for (int d = 0; d < 3; ++d)
            for (int image = -9; image <= 9; ++image) {
                const double shift = cell.along(d) ? image * cell.length[d] : 0.0;
                const double gap = std::max({a.min[d] - b.max[d] - shift, b.min[d] + shift - a.max[d], 0.0});
                nearest[d] = std::min(nearest[d], gap);
            }
        CHECK((cell.apart(a, b) - nearest).norm() < 1e-12);
    }
}

TEST_CASE("pairs are found across periodic borders, each once", "[neighbor_search][periodicity]")
{
    const auto& periodicity = cells[GENERATE(range<std::size_t>(0, cells.size()))];
    const auto count = GENERATE(as<std::size_t>{}, 2, 25, 200);
    const auto seed = GENERATE(1u, 2u, 3u);
    const auto boxes = random_boxes(random_places(count, periodicity, seed), seed);
    std::vector<IndexPair> expected;
    std::size_t across = 0;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i)
        for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(count); ++j)
            if (meet(boxes[i], boxes[j], periodicity)) {
                expected.push_back({i, j});
                across += !boxes[i].meets(boxes[j]);
            }
    if (count == 200) REQUIRE(across > 10);
    CHECK(sorted(find_box_pairs(boxes, periodicity)) == expected);
    CHECK(find_box_pairs_brute_force(boxes, periodicity) == expected);

    const int every = GENERATE(1, 3, 20);
    std::vector<std::int32_t> movers;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); i += every) movers.insert(movers.begin(), i);
    std::erase_if(expected, [&](const IndexPair& pair) { return pair.a % every != 0 && pair.b % every != 0; });
    CHECK(sorted(find_box_pairs(boxes, movers, periodicity)) == expected);
}

TEST_CASE("two tiles of one colour share no sphere through pairs across periodic borders", "[tiles][periodicity]")
{
    const auto& periodicity = cells[GENERATE(range<std::size_t>(0, cells.size()))];
    const auto seed = GENERATE(1u, 2u, 3u);
    const double shrink = GENERATE(1.0, 0.3); // of the boxes: more tiles
    const auto places = random_places(1500, periodicity, seed);
    std::vector<Box> boxes;
    for (const Vec3& x : places) boxes.push_back(Box{x, x}.grown(0.5 * shrink));
    const auto pairs = find_box_pairs(boxes, periodicity);
    double farthest = 0.0;
    for (const auto& [a, b] : pairs)
        farthest = std::max(farthest, periodicity.nearest_image(places[a] - places[b]).lpNorm<Eigen::Infinity>());

    const TileGrid grid(2.001 * farthest, periodicity, Vec3(0.3, -7, 0));
    std::set<std::uint64_t> cells_used;
    bool shared = false;
    std::map<std::pair<std::size_t, std::int32_t>, std::uint64_t> user;
    for (const auto& [a, b] : pairs) {
        const auto cell = grid.cell(places[static_cast<std::size_t>(a)]);
        cells_used.insert(cell);
        for (const auto i : {a, b})
            shared = shared || user.try_emplace({TileGrid::color(cell), i}, cell).first->second != cell;
    }
    CHECK(cells_used.size() > Tiles::colors);
    CHECK_FALSE(shared);
    for (const Vec3& x : places)
        for (const Vec3& shift : periodicity.neighbor_shifts()) CHECK(grid.cell(x + shift) == grid.cell(x));
}
