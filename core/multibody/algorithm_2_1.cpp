// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_2_1.hpp"

#include "core/multibody/body_constraints.hpp"

namespace talus::multibody
{
namespace
{

/// r = G v + Σ λ − q, eq. (14).
Eigen::VectorXd residual(const Iterate& x)
{
    const Problem& p = x.problem();
    Eigen::VectorXd r(p.rows());
    for (std::size_t k = 0; k < p.constraints().size(); ++k) x.residual_of(k, p.rows_of(k, r));
    return r;
}

} // namespace

IterationReport solve_with_residual_update(Iterate& x, const SolveSettings& settings, const SweepObserver& observer)
{
    const Problem& p = x.problem();
    const DiagonalBlocks D(x, LocalSolve::block);
    const auto constraints_of = constraints_by_body(p);
    Eigen::VectorXd r = residual(x), z;

    const auto sweep = [&](const std::vector<std::size_t>& sequence, double omega) {
        SweepSums sums;
        for (const std::size_t k : sequence) {
            z = -omega * (D.local(p.constraints()[k], k).inverse * p.rows_of(k, r));
            p.rows_of(k, r) += p.rows_of(k, p.compliance()).cwiseProduct(z);
            for (std::size_t i = p.first_block(k); i < p.first_block(k + 1); ++i) {
                const Eigen::VectorXd d_b = p.response(i) * z;
                for (const auto& c : constraints_of[p.body_of_block(i)])
                    p.rows_of(c.constraint, r) += p.jacobian(c.block) * d_b;
            }
            x.add(k, z); // v, and λ, which the note never updates
            sums.change += p.rows_of(k, D.weight()).dot(z.cwiseAbs2());
        }
        sums.size = D.weight().dot(x.impulse().cwiseAbs2());
        return sums;
    };
    return repeat_until_small(
        settings, p.constraints().size(), natural_map_sums(Iterate(p), D), sweep,
        [&] { return natural_map_sums(x, D); }, observer);
}

} // namespace talus::multibody
