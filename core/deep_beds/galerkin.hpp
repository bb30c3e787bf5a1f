// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/deep_beds/hat_grid.hpp"
#include "core/deep_beds/load.hpp"

#include <Eigen/SparseCore>

#include <vector>

namespace talus
{

/// The energy ½ v·Mv − λ·q of all bodies where the impulse of each load is multiplied by 1 + Σ_s α_s φ_s:
///
///   E(α) = E(0) + power·α + ½ α·A α,   A_st = Σ_bodies F_s·M⁻¹F_t,   F_s = Σ_loads φ_s Gᵀλ  on that body
struct CoarseEnergy {
    Eigen::SparseMatrix<double> curvature; ///< A
    Eigen::VectorXd power;                 ///< Σ φ_s λ·y
    Eigen::VectorXd unsliding;             ///< Σ φ_s λ·y without the rows that slide
    std::vector<std::int32_t> row_of;      ///< by node of the grid: its row, or −1 where nothing is loaded
};

/// Cells in parallel; the order of the sums depends on positions alone.
CoarseEnergy coarse_energy(const Loads& loads, const HatGrid& grid, const State& state, const Model& model);

/// Calls use(row, φ) for the eight nodes round a load.
template <class Use>
void for_each_hat(const Load& load, const HatGrid& grid, const std::vector<std::int32_t>& row_of, Use&& use)
{
    for (int corner = 0; corner < 8; ++corner) {
        const auto at = corner_of_cell(corner);
        const auto& cell = load.place.cell;
        use(row_of[grid.number({cell[0] + at[0], cell[1] + at[1], cell[2] + at[2]})], load.place.hat(at));
    }
}

} // namespace talus
