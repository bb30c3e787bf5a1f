// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// How the tiles lie along each axis.
class TileAxes
{
public:
    TileAxes(const Box& around, double edge, const Periodicity& periodicity, const Vec3& corner)
    {
        const double common = countable_edge(edge, around.extent());
        for (int d = 0; d < 3; ++d) {
            origin_[d] = corner[d];
            edge_[d] = common;
            if (periodicity.along(d)) {
                const auto pairs = static_cast<std::int64_t>(0.5 * periodicity.length[d] / common);
                last_[d] = std::max<std::int64_t>(1, 2 * pairs) - 1;
                origin_[d] = periodicity.origin[d];
                edge_[d] = periodicity.length[d] / static_cast<double>(last_[d] + 1);
                first_[d] = 0;
            }
            lowest_[d] = index(around.min, d);
        }
    }

    std::int64_t index(const Vec3& x, int d) const
    {
        const auto k = static_cast<std::int64_t>(std::floor((x[d] - origin_[d]) / edge_[d]));
        return std::clamp(k, first_[d], last_[d]);
    }

    std::int64_t lowest(int d) const { return lowest_[d]; }

private:
    static constexpr std::int64_t endless = std::numeric_limits<std::int64_t>::max();

    double origin_[3], edge_[3];
    std::int64_t first_[3] = {-endless, -endless, -endless}, last_[3] = {endless, endless, endless}, lowest_[3];
};

} // namespace

Tiles make_tiles(const std::vector<Vec3>& position, double edge, const Periodicity& periodicity, const Vec3& corner)
{
    Tiles tiles;
    if (position.empty()) return tiles;
    Box around;
    for (const auto& x : position) around.extend(x);
    const TileAxes axes(around, edge, periodicity, corner);

    // Key: colour first, then the tile's place, so that sorting lines up tiles by colour.
    std::vector<std::pair<std::uint64_t, std::int32_t>> keys(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
        std::uint64_t color = 0;
        std::uint64_t place = 0;
        for (std::size_t d = 3; d-- > 0;) {
            const auto index = axes.index(position[i], static_cast<int>(d));
            color = 2 * color + static_cast<std::uint64_t>(index & 1);
            place = (place << bits) + static_cast<std::uint64_t>(index - axes.lowest(static_cast<int>(d)));
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
