// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/iterate.hpp"
#include "core/multibody/iteration.hpp"

namespace talus::multibody
{

/// Algorithm 2.1: Gauss–Seidel iterations on S_ε λ = q − G v⁽¹⁾ with the residual of all rows kept up to date through
/// the lists body → constraints, eq. (15).
///
/// @param x where to start, and where it ends
/// @pre all constraints are equalities; settings.local is not read
IterationReport solve_with_residual_update(
    Iterate& x, const SolveSettings& settings, const SweepObserver& observer = {});

} // namespace talus::multibody
