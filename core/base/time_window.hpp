// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

namespace talus
{

/// The steady part of a run, over which a sensor averages [s].
struct TimeWindow {
    double from = 0.0;
    double to = infinity;

    bool contains(double time) const { return time >= from && time <= to; }
};

} // namespace talus
