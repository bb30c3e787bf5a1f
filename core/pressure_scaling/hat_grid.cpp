// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pressure_scaling/hat_grid.hpp"

#include <cmath>

namespace talus
{
namespace
{

constexpr double most_nodes = 1 << 22;
constexpr int fewest_round = 3;    ///< nodes along a periodic axis: none may be another's neighbour on both sides
constexpr std::int32_t margin = 4; ///< nodes beyond the box on its upper side: a body reaches three, and rounding

std::int32_t wrapped(std::int32_t k, std::int32_t n)
{
    return (k % n + n) % n;
}

} // namespace

HatGrid::HatGrid(double spacing, const Box& around, const Periodicity& periodicity, const Vec3& corner)
    : origin_(corner)
{
    do {
        spacing_.setConstant(spacing);
        for (int d = 0; d < 3; ++d) {
            periodic_[d] = periodicity.along(d);
            if (periodic_[d]) {
                const auto parts = static_cast<std::int32_t>(periodicity.length[d] / spacing);
                extent_[d] = parts >= fewest_round ? parts : 1;
                origin_[d] = periodicity.origin[d];
                spacing_[d] = periodicity.length[d] / extent_[d];
                low_[d] = 0;
            } else {
                low_[d] = static_cast<std::int32_t>(std::floor((around.min[d] - corner[d]) / spacing)) - 1;
                extent_[d] =
                    static_cast<std::int32_t>(std::floor((around.max[d] - corner[d]) / spacing)) + margin - low_[d];
            }
        }
        spacing *= 2.0;
    } while (static_cast<double>(extent_[0]) * extent_[1] * extent_[2] > most_nodes);
}

HatPlace HatGrid::place_of(const Vec3& x) const
{
    HatPlace place;
    for (int d = 0; d < 3; ++d) {
        if (periodic_[d] && extent_[d] == 1) continue;
        const double along = (x[d] - origin_[d]) / spacing_[d];
        const double below = std::floor(along);
        const auto cell = static_cast<std::int32_t>(below);
        place.cell[d] = periodic_[d] ? wrapped(cell, extent_[d]) : cell;
        place.fraction[d] = along - below;
    }
    return place;
}

std::int32_t HatGrid::cells_between(int axis, std::int32_t from, std::int32_t to) const
{
    if (!periodic_[axis]) return to - from;
    const auto forward = wrapped(to - from, extent_[axis]);
    return 2 * forward > extent_[axis] ? forward - extent_[axis] : forward;
}

std::size_t HatGrid::node_count() const
{
    return static_cast<std::size_t>(extent_[0]) * static_cast<std::size_t>(extent_[1]) *
           static_cast<std::size_t>(extent_[2]);
}

std::size_t HatGrid::number(const LatticeIndex& node) const
{
    std::size_t number = 0;
    for (int d = 3; d-- > 0;) {
        const auto k = periodic_[d] ? wrapped(node[d], extent_[d]) : node[d] - low_[d];
        number = number * static_cast<std::size_t>(extent_[d]) + static_cast<std::size_t>(k);
    }
    return number;
}

LatticeIndex HatGrid::node(std::size_t number) const
{
    LatticeIndex node;
    for (int d = 0; d < 3; ++d) {
        const auto n = static_cast<std::size_t>(extent_[d]);
        node[d] = low_[d] + static_cast<std::int32_t>(number % n);
        number /= n;
    }
    return node;
}

} // namespace talus
