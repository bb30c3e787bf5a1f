// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/log_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{

void LogHistogram::add(double value)
{
    // bin k > 0 holds those up to 10^(least_exponent + k / bins_per_decade)
    const double bins_up = value > 0.0 ? std::ceil(bins_per_decade * (std::log10(value) - least_exponent)) : 0.0;
    const double bin = std::clamp(bins_up, 0.0, static_cast<double>(counts_.size() - 1));
    ++counts_[static_cast<std::size_t>(bin)];
    ++count_;
    sum_ += value;
    worst_ = std::max(worst_, value);
}

double LogHistogram::mean() const
{
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
}

double LogHistogram::percentile(double share) const
{
    const double wanted = share * static_cast<double>(count_);
    std::int64_t reached = 0;
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
        reached += counts_[bin];
        if (static_cast<double>(reached) < wanted) continue;
        const double edge = std::pow(10.0, least_exponent + static_cast<double>(bin) / bins_per_decade);
        return std::min(edge, worst_);
    }
    return worst_;
}

} // namespace talus
