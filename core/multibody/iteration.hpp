// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/error_measures.hpp"
#include "core/multibody/traversal.hpp"

#include <cmath>
#include <functional>

namespace talus::multibody
{

/// What a user may choose.
struct SolveSettings {
    double tolerance = 1e-4; ///< on ε
    int max_sweeps = 10000;
    double omega = 1.0; ///< relaxation: 0 < ω < 2; 1 is Gauss–Seidel
    Order order = Order::natural;
    std::uint64_t seed = 1; ///< of shuffled orders
    LocalSolve local = LocalSolve::sequential;
};

/// How a solve went.
struct SolveReport {
    int sweeps = 0;
    double residual = 0.0; ///< ε
    bool converged = true; ///< ε ≤ tolerance
    bool finite = true;    ///< false: an impulse was not a number any more, and the solve stopped there
};

/// Called after each sweep with the number of sweeps so far.
using SweepObserver = std::function<void(int)>;

/// "repeat … until error is small, or iteration time is exceeded", lines 5 and 16–23 of the note's algorithms.
/// @param sweep changes the iterate in the order given and returns the sums of its changes; @param measure returns the
/// sums of ε and changes nothing: it has the last word where the changes are small
template <class Sweep, class Measure>
SolveReport repeat_until_small(const SolveSettings& settings, std::size_t constraints, Sweep&& sweep, Measure&& measure,
    const SweepObserver& observer)
{
    Traversal traversal(settings.order, constraints, settings.seed);
    const SweepSums start = measure();
    SolveReport report;
    report.residual = relative_size(start);
    while (report.residual > settings.tolerance && report.sweeps < settings.max_sweeps && report.finite) {
        const SweepSums swept = sweep(traversal.next());
        ++report.sweeps;
        if (observer) observer(report.sweeps);
        report.finite = std::isfinite(swept.change);
        if (relative_size(swept, start.size) <= settings.tolerance || report.sweeps == settings.max_sweeps)
            report.residual = relative_size(measure(), start.size);
    }
    report.converged = report.finite && report.residual <= settings.tolerance;
    return report;
}

} // namespace talus::multibody
