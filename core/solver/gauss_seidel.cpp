// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/gauss_seidel.hpp"

#include "core/solver/contact_kernel.hpp"
#include "core/solver/tile_crew.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace talus
{
namespace
{

constexpr double unrelaxed = 1.0; ///< ω of an ordinary sweep, and of all that measures

template <class R, bool apply>
SweepSums relax_tile(ContactNetwork& network, std::size_t tile, Motion* motion, double relaxation)
{
    SweepSums sums;
    for_each_contact(
        network.contacts, tile, [&](Contact& c, const ContactTerms& terms, const SideRows& rows, auto is_wall) {
            relax<is_wall(), R, apply>(c, terms, rows, motion, relaxation, sums);
        });
    return sums;
}

template <class R> SweepSums warm_start_tile(ContactNetwork& network, std::size_t tile, Motion* motion)
{
    SweepSums sums;
    for_each_contact(
        network.contacts, tile, [&](Contact& c, const ContactTerms& terms, const SideRows& rows, auto is_wall) {
            apply_impulse<is_wall(), R>(c, terms, c.impulse, motion);
            sums.size += terms.inverse_mass_sum * c.impulse.squaredNorm();
            if constexpr (R::rolling) {
                apply_rolling_impulse<is_wall()>(c, rows.rolling->impulse, motion);
                sums.size += rows.rolling->impulse.squaredNorm() / rows.rolling->inertia;
            }
        });
    return sums;
}

/// ε of the corrections in these sums, METHOD (9).
double residual(const SweepSums& sums, double warm_size)
{
    return sums.change == 0.0 ? 0.0 : std::sqrt(sums.change / std::max(sums.size, warm_size));
}

/// The sums of each tile, and those of the pistons.
struct PartialSums {
    std::vector<SweepSums> of_tile;
    SweepSums of_pistons;

    explicit PartialSums(std::size_t tiles) : of_tile(tiles) {}

    /// Added up in tile order, so that it has the same bits whichever thread made which part.
    /// @param relaxation ω of the sweep: tiles change by ω times what their contacts ask for; pistons are not relaxed
    SweepSums total(double relaxation) const
    {
        SweepSums sum;
        for (const auto& part : of_tile) sum += part;
        sum.change /= relaxation * relaxation;
        sum += of_pistons;
        return sum;
    }
};

template <class R> double apply_warm_start(ContactNetwork& network, Motion* motion)
{
    PartialSums sums(network.list.tiles.count());
    const auto work = [&](std::size_t tile) { sums.of_tile[tile] = warm_start_tile<R>(network, tile, motion); };
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) { crew.color_by_color(work); });
    return sums.total(unrelaxed).size;
}

/// Every contact once. Called by all threads of the crew.
template <class R>
void sweep(
    TileCrew& crew, ContactNetwork& network, PistonGroup& pistons, Motion* motion, double relaxation, PartialSums& sums)
{
    crew.color_by_color(
        [&](std::size_t tile) { sums.of_tile[tile] = relax_tile<R, true>(network, tile, motion, relaxation); });
    if (!pistons.empty()) crew.by_one([&] { sums.of_pistons = pistons.sweep(motion); });
}

template <class R> SweepSums sweep_times(int count, ContactNetwork& network, PistonGroup& pistons, Motion* motion)
{
    PartialSums sums(network.list.tiles.count());
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        for (int k = 0; k < count; ++k) sweep<R>(crew, network, pistons, motion, unrelaxed, sums);
    });
    return sums.total(unrelaxed);
}

template <class R>
SolveReport solve(ContactNetwork& network, PistonGroup& pistons, Motion* motion, const SolverSettings& solver,
    double warm_size, int sweeps_made)
{
    const auto tiles = network.list.tiles.count();
    // Two sets of partial sums in turn: a slow thread may still read one sweep's while a fast one writes the next.
    std::array<PartialSums, 2> swept{PartialSums(tiles), PartialSums(tiles)};
    PartialSums measured(tiles);
    // What a correction of the pressures leaves are short waves: with relaxed sweeps after it a load on one of two
    // columns took two to six times as many (hard case 35). Without friction a bed has soft modes, and N_min plain
    // sweeps change its forces too late for them: they swing for ever, below the tolerance. So all but the last of the
    // N_min are relaxed there; the last is plain, for it solves what is alone, such as an impact of two.
    const bool has_soft_modes = !R::friction && solver.stabilisation == Stabilisation::matched;
    const auto is_relaxed = [&](int sweep) {
        if (solver.pressure_scaling) return false;
        return sweep >= solver.min_sweeps || (has_soft_modes && sweep + 1 < solver.min_sweeps);
    };
    SolveReport report;
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        // Every thread goes through the same loop with the same numbers.
        int sweeps = sweeps_made;
        double change = infinity, error = infinity;
        while (error > solver.tolerance && sweeps < solver.max_sweeps) {
            auto& sums = swept[static_cast<std::size_t>(sweeps % 2)];
            const double relaxation = is_relaxed(sweeps) ? solver.relaxation : unrelaxed;
            sweep<R>(crew, network, pistons, motion, relaxation, sums);
            ++sweeps;
            // ε after a sweep is about what the next one would ask for: as much less as this one asked for less than
            // the last.
            const double last_change = std::exchange(change, residual(sums.total(relaxation), warm_size));
            const double expected = change < last_change ? change * change / last_change : change;
            const bool ready = sweeps >= solver.min_sweeps && (expected <= solver.tolerance || change == 0.0);
            if (!ready && sweeps < solver.max_sweeps) continue;
            crew.all_at_once([&](std::size_t tile) {
                measured.of_tile[tile] = relax_tile<R, false>(network, tile, motion, unrelaxed);
            });
            if (!pistons.empty()) crew.by_one([&] { measured.of_pistons = pistons.measure(motion); });
            error = residual(measured.total(unrelaxed), warm_size);
        }
#pragma omp single nowait
        report = {sweeps, error, error <= solver.tolerance};
    });
    return report;
}

} // namespace

void SolveReport::then(const SolveReport& next)
{
    sweeps += next.sweeps;
    residual = std::max(residual, next.residual);
    converged = converged && next.converged;
}

double apply_warm_start(
    ContactNetwork& network, PistonGroup& pistons, std::vector<Motion>& motion, const ModelledPhysics& physics)
{
    const double of_tiles =
        with_rows(physics, [&](auto rows) { return apply_warm_start<decltype(rows)>(network, motion.data()); });
    return of_tiles + pistons.warm_start(motion.data());
}

double sweep_contacts(int count, ContactNetwork& network, PistonGroup& pistons, std::vector<Motion>& motion,
    const ModelledPhysics& physics, double warm_size)
{
    if (count == 0) return infinity;
    return with_rows(physics, [&](auto rows) {
        return residual(sweep_times<decltype(rows)>(count, network, pistons, motion.data()), warm_size);
    });
}

SolveReport solve_contacts(ContactNetwork& network, PistonGroup& pistons, std::vector<Motion>& motion,
    const ModelledPhysics& physics, const SolverSettings& solver, double warm_size, int sweeps_made)
{
    return with_rows(physics, [&](auto rows) {
        return solve<decltype(rows)>(network, pistons, motion.data(), solver, warm_size, sweeps_made);
    });
}

} // namespace talus
