// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/statistics.hpp"

#include <cmath>
#include <numbers>

namespace talus
{

double LineFit::fall_angle() const
{
    return std::atan(-slope()) * 180.0 / std::numbers::pi;
}

void MeanAndError::add(double x)
{
    if (!std::isfinite(x)) return;
    ++count_;
    const double dx = x - mean_;
    mean_ += dx / static_cast<double>(count_);
    squares_ += dx * (x - mean_);
}

double MeanAndError::standard_error() const
{
    if (count_ < 2) return std::numeric_limits<double>::quiet_NaN();
    const auto n = static_cast<double>(count_);
    return std::sqrt(squares_ / (n - 1.0) / n);
}

} // namespace talus
