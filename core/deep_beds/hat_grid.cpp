// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/deep_beds/hat_grid.hpp"

#include <cmath>

namespace talus
{
namespace
{

constexpr double most_nodes = 1 << 22;
constexpr std::int32_t margin = 4; ///< nodes beyond the box on its upper side: a body reaches three, and rounding

} // namespace

HatGrid::HatGrid(double spacing, const Box& around, const Vec3& corner) : origin_(corner), spacing_(0.5 * spacing)
{
    do {
        spacing_ *= 2.0;
        for (int d = 0; d < 3; ++d) {
            low_[d] = static_cast<std::int32_t>(std::floor((around.min[d] - corner[d]) / spacing_)) - 1;
            extent_[d] =
                static_cast<std::int32_t>(std::floor((around.max[d] - corner[d]) / spacing_)) + margin - low_[d];
        }
    } while (static_cast<double>(extent_[0]) * extent_[1] * extent_[2] > most_nodes);
}

HatPlace HatGrid::place_of(const Vec3& x) const
{
    HatPlace place;
    for (int d = 0; d < 3; ++d) {
        const double along = (x[d] - origin_[d]) / spacing_;
        const double below = std::floor(along);
        place.cell[d] = static_cast<std::int32_t>(below);
        place.fraction[d] = along - below;
    }
    return place;
}

std::size_t HatGrid::node_count() const
{
    return static_cast<std::size_t>(extent_[0]) * static_cast<std::size_t>(extent_[1]) *
           static_cast<std::size_t>(extent_[2]);
}

std::size_t HatGrid::number(const LatticeIndex& node) const
{
    std::size_t number = 0;
    for (int d = 3; d-- > 0;)
        number = number * static_cast<std::size_t>(extent_[d]) + static_cast<std::size_t>(node[d] - low_[d]);
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
