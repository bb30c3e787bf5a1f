// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// Sums for the stopping rule: Σ W|δ|² of the corrections and Σ W|λ|² of the impulses, rolling rows by their inertia.
struct SweepSums {
    double change = 0.0;
    double size = 0.0;

    SweepSums& operator+=(const SweepSums& other)
    {
        change += other.change;
        size += other.size;
        return *this;
    }
};

} // namespace talus
