// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/gauss_seidel.hpp"

#include "core/candidates/tile_crew.hpp"
#include "core/contacts/attractions.hpp"
#include "core/solver/whole_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace talus
{
namespace
{

constexpr double unrelaxed = 1.0;               ///< ω of an ordinary sweep, and of all that measures
constexpr std::size_t few_bodies = 1000;        ///< that one thread copies faster than several
constexpr double least_share = 0.1;             ///< of the tolerance, to which it may be tightened …
constexpr double least_tolerance = 1e-3;        ///< … but no further than to this
constexpr double least_sticky_tolerance = 1e-6; ///< … or to this, where attraction presses with what moves nothing
constexpr double errors_left = 2.0;  ///< tolerances that may be missing at the end, by how fast sweeps converge
constexpr double slowest = 1e-5;     ///< 1 − ρ that differs from none
constexpr double motion_share = 7.0; ///< tolerances that errors may be of what contacts change of the motion

std::size_t row_variant(const ModelledPhysics& physics)
{
    return with_rows(physics, [](auto rows) { return decltype(rows)::index; });
}

/// The kernel's passes over the tiles of a step.
struct TilePasses {
    const SweepKernel kernel;
    StepContacts& contacts;
    double* bodies;

    TilePasses(ContactNetwork& network, std::vector<Body>& of_all, const ModelledPhysics& physics)
        : kernel(fastest_kernels().sweep[row_variant(physics)]), contacts(network.contacts),
          bodies(reinterpret_cast<double*>(of_all.data()))
    {
    }

    SweepSums relax(std::size_t tile, double relaxation) const
    {
        return kernel.relax(contacts.spheres[tile].span(), contacts.walls[tile].span(), bodies, relaxation);
    }
    SweepSums measure(std::size_t tile) const
    {
        return kernel.measure(contacts.spheres[tile].span(), contacts.walls[tile].span(), bodies);
    }
    void warm_start(std::size_t tile) const
    {
        kernel.warm_start(contacts.spheres[tile].span(), contacts.walls[tile].span(), bodies);
    }
};

/// ε of the corrections in these sums, METHOD (9).
double residual(const SweepSums& sums)
{
    return sums.change == 0.0 ? 0.0 : std::sqrt(sums.change / sums.size);
}

/// What of a tolerance sweeps that change so much may leave as ε: where every sweep changes ρ of what the last one did,
/// 1/(1 − ρ) of a change are still missing.
double share_of_tolerance(double change, double last_change)
{
    if (change == 0.0) return 1.0;
    const double left = errors_left * (1.0 - change / last_change);
    return left > slowest ? std::min(left, 1.0) : slowest;
}

/// Σ m |v − v⁽¹⁾|², twice the kinetic energy of what contacts have changed of the motion [J].
double changed_motion(const std::vector<Vec3>& free_velocity, const std::vector<Body>& bodies)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        sum += (bodies[i].velocity - free_velocity[i]).squaredNorm() / bodies[i].inverse_mass;
    return sum;
}

/// The sums of each tile, and those of the pistons.
struct PartialSums {
    std::vector<SweepSums> of_tile;
    SweepSums of_pistons;

    explicit PartialSums(std::size_t tiles) : of_tile(tiles) {}

    /// @param relaxation ω of the sweep: tiles change by ω times what their contacts ask for; pistons are not relaxed
    SweepSums total(double relaxation) const
    {
        SweepSums sum{added_up(&SweepSums::change), added_up(&SweepSums::size)};
        sum.change /= relaxation * relaxation;
        sum += of_pistons;
        return sum;
    }

private:
    /// Added up as whole numbers of a small unit: so the bits do not depend on the order of the tiles.
    double added_up(double SweepSums::*which) const
    {
        double largest = 0.0;
        for (const SweepSums& part : of_tile) largest = part.*which > largest ? part.*which : largest;
        int exponent = 0, tiles = 0;
        std::frexp(largest, &exponent);
        std::frexp(static_cast<double>(of_tile.size()), &tiles);
        if (!(largest < infinity) || largest == 0.0) return largest;
        const double per_unit = std::ldexp(1.0, std::min(62 - tiles - exponent, 1000));
        std::int64_t units = 0;
        bool finite = true;
        for (const SweepSums& part : of_tile) {
            finite = finite && part.*which == part.*which;
            units += finite ? static_cast<std::int64_t>(part.*which * per_unit) : 0;
        }
        return finite ? static_cast<double>(units) / per_unit : std::numeric_limits<double>::quiet_NaN();
    }
};

/// Every contact once. Called by all threads of the crew.
void sweep(TileCrew& crew, const TilePasses& passes, PistonGroup& pistons, std::vector<Body>& bodies, double relaxation,
    PartialSums& sums)
{
    crew.color_by_color([&](std::size_t tile) { sums.of_tile[tile] = passes.relax(tile, relaxation); });
    if (!pistons.empty()) crew.by_one([&] { sums.of_pistons = pistons.sweep(bodies.data()); });
}

} // namespace

void SolveReport::then(const SolveReport& next)
{
    sweeps += next.sweeps;
    residual = std::max(residual, next.residual);
    converged = converged && next.converged;
}

void apply_warm_start(
    ContactNetwork& network, PistonGroup& pistons, std::vector<Body>& bodies, const ModelledPhysics& physics)
{
    network.contacts.free_velocity.resize(bodies.size());
#pragma omp parallel for schedule(static) if (bodies.size() > few_bodies)
    for (std::size_t i = 0; i < bodies.size(); ++i) network.contacts.free_velocity[i] = bodies[i].velocity;
    if (physics.attraction) apply_attractions(network, bodies);
    const TilePasses passes(network, bodies, physics);
    with_tile_crew(network.list.tiles,
        [&](TileCrew& crew) { crew.color_by_color([&](std::size_t tile) { passes.warm_start(tile); }); });
    pistons.warm_start(bodies.data());
}

double tightened(double tolerance, double share)
{
    return std::min(tolerance, std::max(std::clamp(share, least_share, 1.0) * tolerance, least_tolerance));
}

double relaxation_of(int sweep, const ModelledPhysics& physics, const SolverSettings& solver)
{
    // What a correction of the pressures leaves are short waves: with relaxed sweeps after it a load on one of two
    // columns took two to six times as many (hard case 35). Without friction a bed has soft modes, and N_min plain
    // sweeps change its forces too late for them: they swing for ever, below the tolerance. So all but the last of the
    // N_min are relaxed there; the last is plain, for it solves what is alone, such as an impact of two.
    if (solver.pressure_scaling) return unrelaxed;
    const bool has_soft_modes = !physics.friction && solver.stabilisation == Stabilisation::matched;
    const bool relaxed = sweep >= solver.min_sweeps || (has_soft_modes && sweep + 1 < solver.min_sweeps);
    return relaxed ? solver.relaxation : unrelaxed;
}

double sweep_contacts(
    int count, ContactNetwork& network, PistonGroup& pistons, std::vector<Body>& bodies, const ModelledPhysics& physics)
{
    if (count == 0) return infinity;
    const TilePasses passes(network, bodies, physics);
    PartialSums sums(network.list.tiles.count());
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        for (int k = 0; k < count; ++k) sweep(crew, passes, pistons, bodies, unrelaxed, sums);
    });
    return residual(sums.total(unrelaxed));
}

SolveReport solve_contacts(ContactNetwork& network, PistonGroup& pistons, std::vector<Body>& bodies,
    const ModelledPhysics& physics, const SolverSettings& solver, int sweeps_made)
{
    const TilePasses passes(network, bodies, physics);
    const auto tiles = network.list.tiles.count();
    // Two sets of partial sums in turn: a slow thread may still read one sweep's while a fast one writes the next.
    std::array<PartialSums, 2> swept{PartialSums(tiles), PartialSums(tiles)};
    PartialSums measured(tiles);
    double changed = 0.0;
    SolveReport report;
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        // Every thread goes through the same loop with the same numbers.
        int sweeps = sweeps_made;
        double change = infinity, error = infinity, tolerance = solver.tolerance;
        bool converged = false;
        while (!converged && sweeps < solver.max_sweeps) {
            auto& sums = swept[static_cast<std::size_t>(sweeps % 2)];
            const double relaxation = relaxation_of(sweeps, physics, solver);
            sweep(crew, passes, pistons, bodies, relaxation, sums);
            ++sweeps;
            // ε after a sweep is about what the next one would ask for: as much less as this one asked for less than
            // the last.
            const double last_change = std::exchange(change, residual(sums.total(relaxation)));
            const double expected = change < last_change ? change * change / last_change : change;
            const double asked = solver.to_the_end ? tolerance * share_of_tolerance(change, last_change) : tolerance;
            const bool ready = sweeps >= solver.min_sweeps && (expected <= asked || change == 0.0);
            if (!ready && sweeps < solver.max_sweeps) continue;
            crew.all_at_once([&](std::size_t tile) { measured.of_tile[tile] = passes.measure(tile); });
            if (!pistons.empty()) crew.by_one([&] { measured.of_pistons = pistons.measure(bodies.data()); });
            const SweepSums sums_of_error = measured.total(unrelaxed);
            error = residual(sums_of_error);
            converged = error <= asked;
            if (!converged || (solver.stabilisation == Stabilisation::projected && !physics.attraction)) continue;
            // Where loads are large beside what they change of the motion, errors that are small beside them are not,
            // and springs go on with them. (Rigid rows that contradict each other only grow with further sweeps.)
            crew.by_one([&] { changed = changed_motion(network.contacts.free_velocity, bodies); });
            const double size = sums_of_error.size;
            const double share = size > 0.0 ? motion_share * std::sqrt(changed / size) : 1.0;
            tolerance = physics.attraction
                            ? std::min(solver.tolerance, std::max(share * solver.tolerance, least_sticky_tolerance))
                            : tightened(solver.tolerance, share);
            converged = error <= tolerance;
        }
#pragma omp single nowait
        report = {sweeps, error, converged};
    });
    return report;
}

} // namespace talus
