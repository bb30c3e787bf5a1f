// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_3_1.hpp"

namespace talus::multibody
{

template <class AnyIterate>
ProjectedGaussSeidel<AnyIterate>::ProjectedGaussSeidel(const AnyIterate& x, LocalSolve local)
    : blocks_(x, local), local_(local)
{
}

template <class AnyIterate>
SweepSums ProjectedGaussSeidel<AnyIterate>::sweep(AnyIterate& x, const std::vector<std::size_t>& sequence, double omega)
{
    SweepSums sums;
    for (const std::size_t k : sequence) {
        const Constraint& constraint = x.constraints()[k];
        const auto impulse = x.impulse().segment(constraint.first_row, constraint.rows);
        y_.resize(constraint.rows);
        x.residual_of(k, y_);
        z_ = impulse;
        solve_locally(local_, blocks_.local(constraint, k, omega), y_, z_);
        const auto weight = blocks_.weight().segment(constraint.first_row, constraint.rows);
        sums.size += weight.dot(z_.cwiseAbs2());
        z_ -= impulse; // Δλ_k of (17)
        sums.change += weight.dot(z_.cwiseAbs2());
        x.add(k, z_); // v, and λ_k ← z, which the note's listing leaves out
    }
    return sums;
}

template <class AnyIterate>
IterationReport solve_projected(AnyIterate& x, const SolveSettings& settings, const SweepObserver& observer)
{
    ProjectedGaussSeidel<AnyIterate> algorithm(x, settings.local);
    return repeat_until_small(
        settings, x.constraints().size(), algorithm.measure(AnyIterate(x.problem())),
        [&](const std::vector<std::size_t>& sequence, double omega) { return algorithm.sweep(x, sequence, omega); },
        [&] { return algorithm.measure(x); }, observer);
}

template class ProjectedGaussSeidel<Iterate>;
template class ProjectedGaussSeidel<AssembledIterate>;
template IterationReport solve_projected(Iterate&, const SolveSettings&, const SweepObserver&);
template IterationReport solve_projected(AssembledIterate&, const SolveSettings&, const SweepObserver&);

} // namespace talus::multibody
