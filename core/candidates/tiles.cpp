// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{

TileGrid::TileGrid(double edge, const Periodicity& periodicity, const Vec3& corner)
{
    for (int d = 0; d < 3; ++d) {
        Axis& axis = axes_[static_cast<std::size_t>(d)];
        axis = {corner[d], edge, 0};
        if (!periodicity.along(d)) continue;
        const double pairs = std::min(std::floor(0.5 * periodicity.length[d] / edge), std::ldexp(0.5, bits));
        axis.period = std::max<std::int64_t>(1, 2 * static_cast<std::int64_t>(pairs));
        axis.origin = periodicity.origin[d];
        axis.edge = periodicity.length[d] / static_cast<double>(axis.period);
    }
}

std::int64_t TileGrid::Axis::index(double x) const
{
    constexpr double middle = 1 << (bits - 1);
    const double along = std::floor((x - origin) / edge);
    if (period == 0) return static_cast<std::int64_t>(std::clamp(along + middle, 0.0, 2.0 * middle - 1.0));
    const auto turns = static_cast<double>(period);
    return std::min(static_cast<std::int64_t>(along - turns * std::floor(along / turns)), period - 1);
}

std::uint64_t TileGrid::cell(const Vec3& place) const
{
    std::uint64_t color = 0, at = 0;
    for (std::size_t d = 3; d-- > 0;) {
        const auto index = static_cast<std::uint64_t>(axes_[d].index(place[static_cast<int>(d)]));
        color = 2 * color + (index & 1U);
        at = (at << bits) + index;
    }
    return (color << (3 * bits)) + at;
}

std::int32_t Tiles::of_cell(std::uint64_t cell) const
{
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    return found != cells.end() && *found == cell ? static_cast<std::int32_t>(found - cells.begin()) : -1;
}

void Tiles::open(std::vector<std::uint64_t> needed)
{
    if (std::ranges::none_of(needed, [&](std::uint64_t cell) { return of_cell(cell) < 0; })) return;
    for (std::size_t t = 0; t < count(); ++t)
        if (!tiles[t].pairs.empty()) needed.push_back(cells[t]);
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    std::vector<Tile> opened(needed.size());
    for (std::size_t t = 0; t < needed.size(); ++t)
        if (const auto old = of_cell(needed[t]); old >= 0) opened[t] = std::move(tiles[static_cast<std::size_t>(old)]);
    tiles = std::move(opened);
    cells = std::move(needed);
    color_first = {};
    for (const std::uint64_t cell : cells) ++color_first[TileGrid::color(cell) + 1];
    std::partial_sum(color_first.begin(), color_first.end(), color_first.begin());
}

std::size_t Tiles::pair_count() const
{
    std::size_t pairs = 0;
    for (const Tile& tile : tiles) pairs += tile.pairs.size();
    return pairs;
}

SortedByTile::SortedByTile(const std::vector<std::int32_t>& tile, std::size_t tiles) : first_(tiles + 1, 0)
{
    for (const std::int32_t t : tile)
        if (t >= 0) ++first_[static_cast<std::size_t>(t) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    places_.resize(first_.back());
    auto next = first_;
    for (std::size_t place = 0; place < tile.size(); ++place)
        if (tile[place] >= 0)
            places_[next[static_cast<std::size_t>(tile[place])]++] = static_cast<std::uint32_t>(place);
}

} // namespace talus
