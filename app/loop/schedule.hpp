// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace talus
{

/// Times at 0, 1, 2, … intervals. Each is met at the first time asked about that is not before it, so nothing drifts.
class Schedule
{
public:
    /// @param interval [s] > 0; infinity: only time 0
    explicit Schedule(double interval) : interval_(interval) {}

    /// Whether something is due at this time [s]; if so, next comes the first due time after it.
    bool due(double time)
    {
        if (time < next_ * (1.0 - rounding)) return false;
        next_ = interval_ * (std::floor(time / interval_ * (1.0 + rounding)) + 1.0);
        return true;
    }

private:
    static constexpr double rounding = 1e-9; ///< a time a hair before its due time is that time
    double interval_;
    double next_ = 0.0;
};

} // namespace talus
