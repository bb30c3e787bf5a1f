// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/error_measures.hpp"
#include "core/multibody/traversal.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace talus::multibody
{

/// What a user may choose.
struct SolveSettings {
    double tolerance = 1e-4; ///< on ε
    int max_sweeps = 10000;
    /// Relaxation of each sweep, the last one of all that follow: 0 < ω < 2; 1 is Gauss–Seidel.
    std::vector<double> omega = {1.0};
    Order order = Order::natural;
    std::uint64_t seed = 1; ///< of shuffled orders
    LocalSolve local = LocalSolve::sequential;

    /// @param sweep from 0 on
    double omega_of(int sweep) const { return omega[std::min(static_cast<std::size_t>(sweep), omega.size() - 1)]; }
};

/// How a solve went.
struct IterationReport {
    int sweeps = 0;
    double residual = 0.0; ///< ε
    bool converged = true; ///< ε ≤ tolerance, and not only because the impulses have grown
    bool finite = true;    ///< false: an impulse was not a number any more, and the solve stopped there
    bool growing = false;  ///< true: ε ≤ tolerance, but the laws are broken as before: there may be no solution
};

/// Called after each sweep with the number of sweeps so far.
using SweepObserver = std::function<void(int)>;

/// Where no impulses can fulfil the laws (a body pressed from two sides, equalities that contradict each other), the
/// impulses grow without end and ε, which is relative to them, falls. So of the corrections that a contact alone would
/// make at λ = 0, no more than this share may be left, in the norm of ε.
inline constexpr double most_left_of_start = 0.1;

/// "repeat … until error is small, or iteration time is exceeded", lines 5 and 16–23 of the note's algorithms.
/// @param at_rest the sums of ε at λ = 0
/// @param sweep changes the iterate in the order given, relaxed by ω, and returns the sums of its changes; @param
/// measure returns the sums of ε and changes nothing: it has the last word where the changes are small
template <class Sweep, class Measure>
IterationReport repeat_until_small(const SolveSettings& settings, std::size_t constraints, const SweepSums& at_rest,
    Sweep&& sweep, Measure&& measure, const SweepObserver& observer)
{
    Traversal traversal(settings.order, constraints, settings.seed);
    const double most_left = most_left_of_start * most_left_of_start * at_rest.change;
    IterationReport report;
    const auto judge = [&](const SweepSums& error) {
        report.residual = relative_size(error);
        const bool small = report.residual <= settings.tolerance;
        report.finite = std::isfinite(error.change);
        report.growing = small && error.change > most_left;
        report.converged = small && !report.growing && report.finite;
    };
    judge(measure());
    while (!report.converged && report.sweeps < settings.max_sweeps && report.finite) {
        const double omega = settings.omega_of(report.sweeps);
        SweepSums swept = sweep(traversal.next(), omega);
        swept.change /= omega * omega; // what the constraints asked for
        ++report.sweeps;
        if (observer) observer(report.sweeps);
        report.finite = std::isfinite(swept.change);
        const bool last = report.sweeps == settings.max_sweeps || !report.finite;
        if (relative_size(swept) <= settings.tolerance || last) judge(measure());
    }
    return report;
}

} // namespace talus::multibody
