// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/curve_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace talus
{
namespace
{

constexpr std::uint32_t highest_bit = 1U << 20; ///< of a coordinate along one axis

} // namespace

std::uint64_t curve_key(const Vec3& place, const Vec3& corner, double edge)
{
    std::array<std::uint32_t, 3> x{};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto axis = static_cast<int>(d);
        const double along = std::floor((place[axis] - corner[axis]) / edge) + highest_bit;
        x[d] = static_cast<std::uint32_t>(std::clamp(along, 0.0, 2.0 * highest_bit - 1.0));
    }
    // From the coarsest cube to the finest: turn the axes as the curve does in there.
    for (std::uint32_t bit = highest_bit; bit > 1; bit >>= 1)
        for (std::uint32_t& along : x) {
            const std::uint32_t differ = (x[0] ^ along) & (bit - 1);
            if (along & bit)
                x[0] ^= bit - 1;
            else {
                x[0] ^= differ;
                along ^= differ;
            }
        }
    // Gray code.
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t turn = 0;
    for (std::uint32_t bit = highest_bit; bit > 1; bit >>= 1)
        if (x[2] & bit) turn ^= bit - 1;
    std::uint64_t key = 0;
    for (std::uint32_t bit = highest_bit; bit > 0; bit >>= 1)
        for (const std::uint32_t along : x) key = 2 * key + ((along ^ turn) & bit ? 1 : 0);
    return key;
}

std::vector<std::int32_t> curve_order(const std::vector<std::uint64_t>& key, const std::vector<std::int64_t>& id)
{
    std::vector<std::int32_t> along(key.size()), order(key.size());
    std::iota(along.begin(), along.end(), 0);
    std::ranges::sort(along, {},
        [&](std::int32_t i) { return std::pair(key[static_cast<std::size_t>(i)], id[static_cast<std::size_t>(i)]); });
    for (std::size_t k = 0; k < along.size(); ++k)
        order[static_cast<std::size_t>(along[k])] = static_cast<std::int32_t>(k);
    return order;
}

} // namespace talus
