// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tiles.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr int bits = 20; ///< of a tile index along one axis, in the sorting key

/// The tile edge, doubled until the tiles along each axis can be counted in the key.
double countable_edge(double edge, const Vec3& extent)
{
    while (extent.maxCoeff() / edge > (1 << bits) - 4) edge *= 2.0;
    return edge;
}

} // namespace

Tiles make_tiles(const std::vector<Vec3>& position, double edge)
{
    Tiles tiles;
    if (position.empty()) return tiles;
    Box around;
    for (const auto& x : position) around.extend(x);
    edge = countable_edge(edge, around.extent());
    const auto index_of = [edge](double x) { return static_cast<std::int64_t>(std::floor(x / edge)); };
    const std::array<std::int64_t, 3> lowest = {
        index_of(around.min[0]), index_of(around.min[1]), index_of(around.min[2])};

    // Key: colour first, then the tile's place, so that sorting lines up tiles by colour.
    std::vector<std::pair<std::uint64_t, std::int32_t>> keys(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
        std::uint64_t color = 0;
        std::uint64_t place = 0;
        for (std::size_t d = 3; d-- > 0;) {
            const auto index = index_of(position[i][static_cast<Eigen::Index>(d)]);
            color = 2 * color + static_cast<std::uint64_t>(index & 1);
            place = (place << bits) + static_cast<std::uint64_t>(index - lowest[d]);
        }
        keys[i] = {(color << (3 * bits)) + place, static_cast<std::int32_t>(i)};
    }
    std::sort(keys.begin(), keys.end());

    tiles.spheres.reserve(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k > 0 && keys[k].first != keys[k - 1].first) {
            tiles.first.push_back(static_cast<std::uint32_t>(k));
        }
        tiles.spheres.push_back(keys[k].second);
    }
    tiles.first.push_back(static_cast<std::uint32_t>(keys.size()));

    for (std::size_t t = 0; t < tiles.count(); ++t) ++tiles.color_first[(keys[tiles.first[t]].first >> (3 * bits)) + 1];
    for (std::size_t c = 0; c < Tiles::colors; ++c) tiles.color_first[c + 1] += tiles.color_first[c];
    return tiles;
}

} // namespace talus
