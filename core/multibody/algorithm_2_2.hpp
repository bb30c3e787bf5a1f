// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/iterate.hpp"
#include "core/multibody/iteration.hpp"

namespace talus::multibody
{

/// Errors that Algorithm 2.2 can keep while it only ever sees one constraint's rows.
struct RunningError {
    /// ξ as the note updates it: ‖r‖² of the start, minus ‖r_k‖² of each constraint before its update, plus the same
    /// after it. It is not ‖r‖²: an update changes the rows of all neighbours too. It may become negative.
    double of_note = 0.0;

    /// What can be kept that way: by how much the last sweep lowered the energy error ½ (λ − λ*)ᵀ S_ε (λ − λ*) [J]. An
    /// update by ω z, z = −D_kk⁻¹ r_k, lowers it by exactly ω (1 − ω/2) r_kᵀ D_kk⁻¹ r_k.
    double energy_drop = 0.0;
    double energy_drop_before = 0.0; ///< energy_drop of the sweep before [J]

    /// The energy error that is left [J], if the drops go on as a geometric series; infinite while they do not fall.
    double energy_left() const;
};

struct LocalResidualReport : IterationReport {
    RunningError running_error;
};

/// Algorithm 2.2: Gauss–Seidel iterations on S_ε λ = q − G v⁽¹⁾ without residual update: the residual of a constraint
/// is computed from the velocities when its turn comes, eq. (16), and λ is kept.
///
/// @param x where to start, and where it ends
/// @pre all constraints are equalities; settings.local is not read
LocalResidualReport solve_with_local_residual(
    Iterate& x, const SolveSettings& settings, const SweepObserver& observer = {});

} // namespace talus::multibody
