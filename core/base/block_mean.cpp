// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/block_mean.hpp"

#include "core/base/statistics.hpp"

#include <cmath>
#include <limits>

namespace talus
{
namespace
{

constexpr std::size_t most_blocks = 16; ///< even

} // namespace

void BlockMean::add(double x, double weight)
{
    if (blocks_.empty() || in_last_ == block_length_) {
        if (blocks_.size() == most_blocks) join_neighbors();
        blocks_.emplace_back();
        in_last_ = 0;
    }
    ++in_last_;
    if (std::isfinite(x) && weight > 0.0) blocks_.back() += {weight * x, weight};
}

void BlockMean::join_neighbors()
{
    for (std::size_t k = 0; k < most_blocks / 2; ++k) {
        blocks_[k] = blocks_[2 * k];
        blocks_[k] += blocks_[2 * k + 1];
    }
    blocks_.resize(most_blocks / 2);
    block_length_ *= 2;
}

double BlockMean::mean() const
{
    Block all;
    for (const Block& block : blocks_) all += block;
    return all.weight > 0.0 ? all.sum / all.weight : std::numeric_limits<double>::quiet_NaN();
}

double BlockMean::standard_error() const
{
    const std::size_t complete = blocks_.size() - (in_last_ == block_length_ || blocks_.empty() ? 0 : 1);
    MeanAndError means;
    for (std::size_t k = 0; k < complete; ++k) means.add(blocks_[k].sum / blocks_[k].weight);
    return means.standard_error();
}

} // namespace talus
