// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_2_2.hpp"

#include <utility>

namespace talus::multibody
{

double RunningError::energy_left() const
{
    if (energy_drop == 0.0) return 0.0;
    const double ratio = energy_drop / energy_drop_before;
    return ratio < 1.0 ? energy_drop * ratio / (1.0 - ratio) : std::numeric_limits<double>::infinity();
}

LocalResidualReport solve_with_local_residual(Iterate& x, const SolveSettings& settings, const SweepObserver& observer)
{
    const Problem& p = x.problem();
    const DiagonalBlocks D(x, LocalSolve::block);
    Eigen::VectorXd r, z;
    const auto local_residual = [&](std::size_t k) {
        r.resize(p.constraints()[k].rows);
        x.residual_of(k, r);
        return r.squaredNorm();
    };

    RunningError running;
    for (std::size_t k = 0; k < p.constraints().size(); ++k) running.of_note += local_residual(k);

    const auto sweep = [&](const std::vector<std::size_t>& sequence, double omega) {
        SweepSums sums;
        running.energy_drop_before = std::exchange(running.energy_drop, 0.0);
        for (const std::size_t k : sequence) {
            running.of_note -= local_residual(k);
            z = -omega * (D.local(p.constraints()[k], k).inverse * r);
            running.energy_drop -= (1.0 - 0.5 * omega) * r.dot(z);
            x.add(k, z);
            running.of_note += local_residual(k);
            sums.change += p.rows_of(k, D.weight()).dot(z.cwiseAbs2());
        }
        sums.size = D.weight().dot(x.impulse().cwiseAbs2());
        return sums;
    };
    const auto report = repeat_until_small(
        settings, p.constraints().size(), natural_map_sums(Iterate(p), D), sweep,
        [&] { return natural_map_sums(x, D); }, observer);
    return {report, running};
}

} // namespace talus::multibody
