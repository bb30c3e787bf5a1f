// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/algorithm_2_2.hpp"
#include "core/multibody/schur.hpp"
#include "io/problem/fclib_problem.hpp"

#include <optional>
#include <string>

namespace talus
{

/// How a solve went and how long it took.
struct TimedReport : multibody::IterationReport {
    double seconds = 0.0;
    std::optional<multibody::RunningError> running_error = {}; ///< of Algorithm 2.2
};

/// Prints what a file holds.
void print_problem(const FclibProblem& file);

/// Prints what is known of the rank of S.
void print_rank(const multibody::ProblemWithBodies& bodies);
void print_rank(const multibody::AssembledProblem& problem);

/// Prints how a solve went: sweeps, errors, seconds, contact updates a second.
/// @param x where it ended: an Iterate or an AssembledIterate
template <class AnyIterate> void print_result(const AnyIterate& x, const TimedReport& report, double tolerance);

/// Why a solve did not meet its tolerance, in one sentence without its end.
std::string complaint(const TimedReport& report);

} // namespace talus
