// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/block_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
namespace
{

constexpr std::size_t least_blocks = 4; ///< from fewer, their scatter is not known

} // namespace

void BlockMean::add(double x, double weight)
{
    Block block;
    if (std::isfinite(x) && weight > 0.0) block = {weight * x, weight};
    all_ += block;
    for (std::size_t k = 0;; ++k) {
        if (k == levels_.size()) levels_.emplace_back();
        Level& level = levels_[k];
        if (block.weight > 0.0) level.means.add(block.sum / block.weight);
        level.has_first = !level.has_first;
        if (level.has_first) {
            level.first = block;
            return;
        }
        block += level.first;
    }
}

double BlockMean::mean() const
{
    return all_.weight > 0.0 ? all_.sum / all_.weight : std::numeric_limits<double>::quiet_NaN();
}

ErrorOfMean BlockMean::error() const
{
    if (levels_.empty()) return {std::numeric_limits<double>::quiet_NaN(), 0.0, true};
    const double n = static_cast<double>(levels_[0].means.count()), one = levels_[0].means.standard_error();
    if (one == 0.0) return {0.0, n, false}; // it does not change
    double largest = one, length = 1.0;
    for (const Level& level : levels_) {
        if (level.means.count() < least_blocks) break;
        const double error = level.means.standard_error();
        largest = std::max(largest, error);
        const double worth = error * error / (one * one);
        if (length * length * length > 2.0 * n * worth * worth) return {error, n / std::max(1.0, worth), false};
        length *= 2.0;
    }
    return {largest, n * one * one / (largest * largest), true};
}

} // namespace talus
