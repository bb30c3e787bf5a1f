// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"

#include <array>
#include <cstdint>

namespace talus
{

/// How often a quantity from 0 up was how large: mean, percentiles and worst of any number of values in a fixed size.
class LogHistogram
{
public:
    void add(double value);

    double mean() const;
    double worst() const { return worst_; }

    /// What this share of the values does not exceed, at most 2.4 % too large; 0 where there are none.
    double percentile(double share) const;

    void persist(Archive& archive) { archive(counts_, count_, sum_, worst_); }

private:
    static constexpr int bins_per_decade = 100;
    static constexpr int least_exponent = -9;  ///< smaller values share the first bin
    static constexpr int largest_exponent = 3; ///< larger ones the last

    std::array<std::int64_t, bins_per_decade*(largest_exponent - least_exponent) + 1> counts_ = {};
    std::int64_t count_ = 0;
    double sum_ = 0.0, worst_ = 0.0;
};

} // namespace talus
