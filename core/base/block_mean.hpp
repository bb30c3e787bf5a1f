// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/statistics.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// What is known of the error of a mean.
struct ErrorOfMean {
    double error;       ///< standard error; not a number with fewer than two samples
    double independent; ///< as many samples that do not resemble each other would be as good
    bool too_few;       ///< not even the longest blocks are longer than what samples remember, or they are too few to
                        ///< tell: the error is at least as large
};

/// Mean of a quantity that is sampled in time, with its standard error. Samples that resemble the ones just before them
/// add less than as many independent ones. So their means over blocks of 1, 2, 4, … samples are taken: the error that
/// the scatter of these means tells grows with the length of the blocks until they are longer than what samples
/// remember, and is flat from there on (Flyvbjerg & Petersen 1989). It is taken from the shortest blocks, of B of n
/// samples, for which
///
///   B³ > 2 n (e_B / e_1)⁴,    e_B the error by blocks of B                     (Lee, Needs, Towler & Ríos 2011)
///
/// where what blocks still share is as large as the uncertainty of the scatter of so few: (e_B / e_1)² samples are
/// worth an independent one. Memory is logarithmic in the number of samples.
class BlockMean
{
public:
    /// @param weight of the sample. What has no weight or is not a number only takes its place in time.
    void add(double x, double weight = 1.0);

    /// Σ w x / Σ w; not a number without samples.
    double mean() const;

    ErrorOfMean error() const;

    void persist(Archive& archive) { archive(all_, levels_); }

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
    /// Blocks of one length.
    struct Level {
        MeanAndError means;
        bool has_first = false; ///< of two that make one of the next level
        Block first;

        void persist(Archive& archive) { archive(means, has_first, first); }
    };
    Block all_;
    std::vector<Level> levels_;
};

} // namespace talus
