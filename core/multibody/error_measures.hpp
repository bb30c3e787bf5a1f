// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sweep_sums.hpp"
#include "core/multibody/diagonal_blocks.hpp"

namespace talus::multibody
{

/// How far an iterate is from the laws. Each number has one unit, so none depends on the choice of units.
struct ErrorMeasures {
    /// ε = (Σ W|δ|² / Σ W|λ|²)^½, METHOD (9) without its λ⁰, with the natural map δ = λ − P(λ − y/d) in impulse units:
    /// P the projection of constraint.hpp (normal first), d the scale of each row. Zero where all laws hold, and only
    /// there.
    double natural_map = 0.0;
    double worst_velocity_violation =
        0.0;                           ///< largest d|δ| of the rows in m/s: by so much a contact breaks its law [m/s]
    double worst_spin_violation = 0.0; ///< largest d|δ| of the rolling rows [rad/s]
    double cone_violation = 0.0;       ///< worst −λ_n, |λ_t| − μ λ_n [N s], |λ_r| − μ_r R* λ_n [N m s]
};

/// @param iterate an Iterate or an AssembledIterate
template <class AnyIterate> ErrorMeasures measure_errors(const AnyIterate& iterate);

/// The sums of ε alone, with blocks at hand.
template <class AnyIterate> SweepSums natural_map_sums(const AnyIterate& iterate, const DiagonalBlocks& blocks);

/// ε of such sums: zero where nothing is left to correct, infinite where there are no impulses to compare with.
double relative_size(const SweepSums& sums);

} // namespace talus::multibody
