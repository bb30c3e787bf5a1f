// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace talus
{

/// A clock that can be held while something is done that is not to be timed.
class StopWatch
{
public:
    /// What it shows [s].
    double seconds() const { return before_ + (runs_ ? running() : 0.0); }

    void hold()
    {
        before_ = seconds();
        runs_ = false;
    }

    void go_on()
    {
        begun_ = Clock::now();
        runs_ = true;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begun_ = Clock::now();
    double before_ = 0.0; ///< shown when it was last held
    bool runs_ = true;

    double running() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }
};

} // namespace talus
