// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// Mean of a quantity that is sampled in time, with the standard error of the means of successive blocks: samples that
/// resemble the ones just before them add less than as many independent ones, and block means show that.
///
/// There are at most 16 blocks of equally many samples; when they are full, neighbours are joined. So memory is
/// constant, and the error is honest once a block (a sixteenth to an eighth of the time) is longer than the quantity
/// remembers.
class BlockMean
{
public:
    /// @param weight of the sample. What has no weight or is not a number only takes its place in time.
    void add(double x, double weight = 1.0);

    /// Σ w x / Σ w; not a number without samples.
    double mean() const;

    /// Of the complete blocks; not a number with fewer than two.
    double standard_error() const;

    void persist(Archive& archive) { archive(blocks_, block_length_, in_last_); }

private:
    struct Block {
        double sum = 0.0, weight = 0.0;

        Block& operator+=(const Block& other)
        {
            sum += other.sum;
            weight += other.weight;
            return *this;
        }
    };
    std::vector<Block> blocks_;
    std::int64_t block_length_ = 1; ///< samples in a block
    std::int64_t in_last_ = 0;      ///< samples in the last block

    void join_neighbors();
};

} // namespace talus
