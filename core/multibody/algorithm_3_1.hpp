// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/iterate.hpp"
#include "core/multibody/iteration.hpp"
#include "core/multibody/schur.hpp"

namespace talus::multibody
{

/// Algorithm 3.1: projected Gauss–Seidel, each constraint by its law, eq. (17).
/// @tparam AnyIterate Iterate, where residuals come from the velocities, eq. (16), or AssembledIterate, where they come
/// from the rows of S_ε, eq. (9). Both have constraints, impulse, diagonal_block, residual_of and add.
template <class AnyIterate> class ProjectedGaussSeidel
{
public:
    /// @param x an iterate of the problem that will be swept
    ProjectedGaussSeidel(const AnyIterate& x, LocalSolve local);

    /// One sweep over these constraints, in this order. Returns Σ W|Δλ|² and Σ W|λ|² of what it did.
    /// @param omega relaxation, the note's factor on d
    SweepSums sweep(AnyIterate& x, const std::vector<std::size_t>& sequence, double omega = 1.0);

    /// The sums of ε, of an x that is not changed.
    SweepSums measure(const AnyIterate& x) const { return natural_map_sums(x, blocks_); }

private:
    DiagonalBlocks blocks_;
    LocalSolve local_;
    Eigen::VectorXd y_, z_;
};

/// Sweeps until ε ≤ tolerance.
/// @param x where to start, and where it ends
template <class AnyIterate>
IterationReport solve_projected(AnyIterate& x, const SolveSettings& settings, const SweepObserver& observer = {});

} // namespace talus::multibody
